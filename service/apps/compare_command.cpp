// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <memory>

#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/apps/output.hpp"
#include "service/apps/run_session.hpp"
#include "service/pipeline/evaluation/comparison_report.hpp"
#include "service/pipeline/evaluation/matcher_contest.hpp"

namespace qwsm::apps {
namespace {

/// The first one is compared with each of the others.
constexpr std::array kComparedMatchers = {MatcherKind::kQWsm, MatcherKind::kWsm, MatcherKind::kIcp};

ExitCode RunCompare(const RunArguments& arguments) {
  StartMessages(arguments.verbosity);
  const auto options = config::LoadOptions<options::ProgramOptions>(arguments.sources);
  const auto source = OpenLogs(arguments, options.log);
  if (arguments.dry_run) return TellPlan("compare matchers on", arguments);

  const RunSession session(arguments, options);
  pipeline::MatcherContest contest(options.mapper, kComparedMatchers, session.folder());
  const pipeline::ReplayResult end = session.Run("compare", *source, contest.runs());
  contest.Finish(options.rendering, source->truth());
  if (arguments.verbosity.json) {
    Print("{}", pipeline::ComparisonJson(contest.contestants()));
  } else if (!arguments.verbosity.quiet) {
    Print("{}\nresults        {}\n",
          pipeline::ComparisonText(contest.contestants()),
          session.folder().path().string());
  }
  return session.Conclude(end);
}

}  // namespace

Command AddCompareCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "compare", "q-wsm beside wsm and icp on the same logs");
  auto arguments = std::make_shared<RunArguments>();
  parser->footer(
      "  qwsm compare intel.log.gz                        tables, and results in results/latest\n"
      "  qwsm compare intel.log --output intel            intel/q-wsm, intel/wsm, intel/icp ...\n"
      "  qwsm compare intel.log --json                    figures for programs");
  AddRunArguments(*parser, *arguments, "all figures as JSON on standard output");
  AddRobot(*parser, arguments->sources);
  return {.parser = parser, .run = [arguments] { return RunCompare(*arguments); }};
}

}  // namespace qwsm::apps
