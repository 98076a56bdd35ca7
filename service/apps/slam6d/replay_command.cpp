// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "service/apps/number_arguments.hpp"
#include "service/apps/replay_arguments.hpp"
#include "service/apps/slam6d/commands.hpp"
#include "service/apps/slam6d/network.hpp"
#include "service/apps/slam6d/scan_arguments.hpp"
#include "service/pipeline/slam6d/series_source.hpp"
#include "service/pipeline/text/messages.hpp"

namespace slam6d::apps {
namespace {

struct SeriesReplayArguments {
  std::vector<std::filesystem::path> scans;
  std::optional<std::filesystem::path> poses;
  double period_s = 1.0;
  qwsm::apps::ReplayArguments replay;
  NetworkArguments network;
};

ExitCode RunReplay(const SeriesReplayArguments& arguments) {
  const NetworkSession session(arguments.network);
  const qwsm::apps::Verbosity& verbosity = arguments.network.verbosity;
  qwsm::apps::ReplayOptionsOf(arguments.replay, verbosity);  // Wrong ones are told at once.
  const io::NumberedPoses starts =
      arguments.poses ? io::ReadPoses(*arguments.poses) : io::NumberedPoses{};
  const std::vector<pipeline::ScanPlace> places = FindScans(arguments.scans, session.options().bag);
  TellOfBags(places);
  pipeline::ScanSeries series(places, starts, session.options());
  const std::chrono::duration<double> period(arguments.period_s);
  pipeline::SeriesSource source(series,
                                std::chrono::round<std::chrono::nanoseconds>(period),
                                [](const std::string& problem) { qwsm::messages::Warn(problem); });
  if (source.Peek() == nullptr) throw qwsm::apps::UsageError("none of the scans has points");
  return qwsm::apps::Replay<qwsm::team::Spatial>(
      source, arguments.replay, session.options().network, verbosity, "slam6d serve");
}

}  // namespace

Command AddReplayCommand(CLI::App& program) {
  CLI::App* parser =
      AddParser(program, "replay", "3D scans, or a bag of them, as a robot on the network");
  auto arguments = std::make_shared<SeriesReplayArguments>();
  parser->footer(
      "  slam6d replay dat/                     as /points and /odom, a scan a second\n"
      "  slam6d replay dat/ --robot robot1      as /robot1/points and /robot1/odom\n"
      "  slam6d replay drive.mcap               the clouds of a bag, at their own times\n"
      "  slam6d replay dat/ --rate max          as fast as the service answers");
  AddScanArguments(*parser, arguments->scans, arguments->network.sources);
  parser
      ->add_option("--poses",
                   arguments->poses,
                   "odometry: TUM by scan number, or a folder of .pose or .frames")
      ->type_name("FILE");
  parser
      ->add_option("--period",
                   arguments->period_s,
                   "seconds from one scan to the next, where none has a stamp")
      ->check(qwsm::apps::NumberBetween(0.001, 3600.0))
      ->type_name("S")
      ->capture_default_str();
  qwsm::apps::AddReplayArguments(*parser, arguments->replay);
  AddNetworkArguments(*parser, arguments->network, {});
  return {.parser = parser, .run = [arguments] { return RunReplay(*arguments); }};
}

}  // namespace slam6d::apps
