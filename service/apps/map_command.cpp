// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/apps/run_session.hpp"
#include "service/io/map_file.hpp"
#include "service/pipeline/results_writer.hpp"

namespace qwsm::apps {
namespace {

struct MapArguments {
  RunArguments run;
  std::optional<std::string> matcher;
  std::optional<std::filesystem::path> save_map;
};

config::ProgramOptions LoadOptions(const MapArguments& arguments) {
  auto options = config::LoadOptions<config::ProgramOptions>(arguments.run.sources);
  if (arguments.matcher) options.mapper.matcher = MatcherNamed(*arguments.matcher);
  if (arguments.save_map && options.mapper.matcher != MatcherKind::kQWsm) {
    throw UsageError("--save-map needs the matcher q-wsm: the others forget what they have seen");
  }
  return options;
}

ExitCode RunMap(const MapArguments& arguments) {
  StartMessages(arguments.run.verbosity);
  const config::ProgramOptions options = LoadOptions(arguments);
  const auto source = OpenLogs(arguments.run, options.log);
  if (arguments.run.dry_run) return TellPlan("map", arguments.run);

  const RunSession session(arguments.run, options);
  Mapper mapper(options.mapper);
  pipeline::ResultsWriter results(session.folder());
  const pipeline::ReplayResult end = session.Run("map", *source, mapper, results);
  results.Finish(mapper, options.rendering);
  if (arguments.save_map) io::SaveMap(*arguments.save_map, mapper.map());
  session.Summarize(results.statistics(), mapper);
  return Conclude(end);
}

}  // namespace

Command AddMapCommand(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("map", "the robot's path and a map from recorded logs");
  auto arguments = std::make_shared<MapArguments>();
  parser->footer(
      "  qwsm map intel.log.gz                            results in results/latest\n"
      "  qwsm map intel.log --output intel                results in intel/\n"
      "  qwsm map intel.log --matcher wsm                 the incremental baseline\n"
      "  qwsm map intel.log --save-map intel.qwsm         to localize in later\n"
      "  qwsm map robot.log --set mapper.motion.rotation_per_rotation=0.5\n"
      "  zcat *.log.gz | qwsm map - --quiet               from a pipe");
  AddRunArguments(*parser, arguments->run);
  parser->add_option("--matcher", arguments->matcher, "q-wsm, wsm or icp")->type_name("NAME");
  parser->add_option("--save-map", arguments->save_map, "the map, for qwsm localize")
      ->type_name("FILE");
  return {.parser = parser, .run = [arguments] { return RunMap(*arguments); }};
}

}  // namespace qwsm::apps
