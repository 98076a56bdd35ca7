// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/network.hpp"
#include "service/apps/number_arguments.hpp"
#include "service/apps/output.hpp"
#include "service/dds/robot/match_report_reader.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/run/progress_display.hpp"
#include "service/pipeline/team/team_table.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {
namespace {

using namespace std::chrono_literals;
using Clock = pipeline::TeamTable::Clock;

struct WatchArguments {
  std::vector<std::string> robots;
  std::optional<double> duration_s;
  double period_s = 1.0;
  NetworkArguments network;
};

Clock::duration DurationOf(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// Shows a text in the place of the one before, where the terminal can do that; else below it.
class Screen {
 public:
  void Show(const std::string& text) {
    std::string output;
    if (is_terminal_ && lines_ > 0) output = fmt::format("\x1b[{}F\x1b[J", lines_);
    if (!is_terminal_ && lines_ > 0) output = "\n";
    output += text;
    lines_ = std::ranges::count(text, '\n');
    PrintText(output);
  }

 private:
  bool is_terminal_ = pipeline::StyleFor(stdout) == pipeline::ProgressStyle::kBar;
  std::ptrdiff_t lines_ = 0;
};

ExitCode RunWatch(const WatchArguments& arguments) {
  const NetworkSession session(arguments.network);
  const dds::Participant participant(session.options().network);
  dds::MatchReportReader reports(participant, arguments.robots);
  const pipeline::Interruption interruption(pipeline::Interruption::kListensNoMore,
                                            pipeline::Interruption::WithoutReaders::kEnds);
  messages::Info("listening");
  pipeline::TeamTable table;
  Screen screen;
  const auto begin = Clock::now();
  auto next = begin + DurationOf(arguments.period_s);
  while (!interruption.requested()) {
    for (const dds::MatchReport& report : reports.Take(100ms)) table.Take(report, Clock::now());
    const auto now = Clock::now();
    const bool is_over = arguments.duration_s && now - begin > DurationOf(*arguments.duration_s);
    if (now >= next || is_over) {
      screen.Show(table.empty() ? "nobody is reported on yet\n" : table.Text(now));
      next = now + DurationOf(arguments.period_s);
    }
    if (is_over) break;
  }
  return ExitCode::kDone;
}

}  // namespace

Command AddWatchCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "watch", "the team's robots at a glance, live");
  auto arguments = std::make_shared<WatchArguments>();
  parser->footer(
      "  qwsm watch                          all robots, until Ctrl-C\n"
      "  qwsm watch robot1 robot2            these two\n"
      "  qwsm watch --period 10 >> team.txt  a table every ten seconds, one below the other");
  parser->add_option("ROBOT", arguments->robots, "namespaces of robots; else all")->type_name("");
  parser->add_option("--duration", arguments->duration_s, "stop after so many seconds")
      ->check(NumberBetween(0.0, kLongest_s))
      ->type_name("S");
  parser->add_option("--period", arguments->period_s, "seconds between two looks")
      ->check(NumberBetween(0.1, 3600.0))
      ->type_name("S")
      ->capture_default_str();
  AddNetworkArguments(*parser, arguments->network, {});
  return {.parser = parser, .run = [arguments] { return RunWatch(*arguments); }};
}

}  // namespace qwsm::apps
