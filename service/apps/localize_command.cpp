// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/geometry/angle.hpp"
#include "qwsm/geometry/position.hpp"
#include "qwsm/mapping/relocalization.hpp"
#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/apps/number_arguments.hpp"
#include "service/apps/run_session.hpp"
#include "service/io/maps/map_file.hpp"
#include "service/pipeline/results/results_writer.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {
namespace {

struct LocalizeArguments {
  RunArguments run;
  std::filesystem::path map;
  std::vector<double> at;  ///< x and y in metres and the heading in degrees, or nothing.
};

/// The options of the run; of the map, those it was made with.
options::ProgramOptions LoadOptionsFor(const LocalizeArguments& arguments, const ScanMap& map) {
  auto options = config::LoadOptions<options::ProgramOptions>(arguments.run.sources);
  if (options.mapper.matcher != MatcherKind::kQWsm) {
    throw UsageError("localize needs the matcher q-wsm: the others forget the map");
  }
  options.mapper.map = map.options();
  options.mapper.extend_map = false;
  return options;
}

std::string PlaceText(const Pose2& pose) {
  return fmt::format("{:.2f} {:.2f} {:.1f}", pose.x_m, pose.y_m, RadiansToDegrees(pose.theta_rad));
}

/// Where the robot is at its first scan: as was said, else where the scan fits best.
UncertainPose2 FindStart(const LocalizeArguments& arguments,
                         const ScanMap& map,
                         const LaserScan& first) {
  UncertainPose2 start;
  start.covariance = Eigen::Vector3d(0.01, 0.01, 0.003).asDiagonal();  // 0.1 m and 3 degrees.
  if (!arguments.at.empty()) {
    const std::vector<double>& at = arguments.at;
    start.T_a_b = {at[0], at[1], NormalizeAngle(DegreesToRadians(at[2]))};
    return start;
  }
  const std::optional<RelocalizationResult> place = Relocalize(map, ToPoints(first));
  if (!place) {
    throw UsageError(
        "the first scan fits nowhere in the map; is it the right map? --at X Y DEG says where the "
        "robot starts");
  }
  messages::Info("starts at {}", PlaceText(place->best.T_map_robot));
  if (place->rival) {
    messages::Warn("the first scan fits at {} and nearly as well at {}; --at X Y DEG says which",
                   PlaceText(place->best.T_map_robot),
                   PlaceText(place->rival->T_map_robot));
  }
  start.T_a_b = place->best.T_map_robot;
  return start;
}

ExitCode RunLocalize(LocalizeArguments arguments) {
  StartMessages(arguments.run.verbosity);
  arguments.run.other_inputs = {arguments.map};
  ScanMap map = io::LoadMap(arguments.map);
  if (map.empty()) throw UsageError(arguments.map.string() + ": is a map without scans");
  const options::ProgramOptions options = LoadOptionsFor(arguments, map);
  const auto source = OpenLogs(arguments.run, options.log);
  const UncertainPose2 start = FindStart(arguments, map, source->Peek()->scan);
  if (arguments.run.dry_run) return TellPlan("localize", arguments.run);

  const RunSession session(arguments.run, options);
  Mapper mapper(options.mapper, std::move(map), start);
  pipeline::ResultsWriter results(session.folder());
  const pipeline::ReplayResult end = session.Run("localize", *source, mapper, {&results});
  results.Finish(mapper, options.rendering);
  session.Summarize(results, mapper.map());
  return Conclude(end);
}

}  // namespace

Command AddLocalizeCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "localize", "the robot's path in a map that was saved");
  auto arguments = std::make_shared<LocalizeArguments>();
  parser->footer(
      "  qwsm map monday.log --save-map site.qwsm\n"
      "  qwsm localize --map site.qwsm tuesday.log                 finds out where it starts\n"
      "  qwsm localize --map site.qwsm tuesday.log --at 3 -1.5 90  is told so");
  parser->add_option("--map", arguments->map, "saved by qwsm map --save-map")
      ->required()
      ->type_name("MAP");
  parser->add_option("--at", arguments->at, "where the robot starts: metres and degrees")
      ->expected(3)
      ->check(NumberBetween(-kFarthestCoordinate_m, kFarthestCoordinate_m))
      ->type_name("X Y DEG");
  AddRunArguments(*parser, arguments->run);
  AddRobot(*parser, arguments->run.sources);
  return {.parser = parser, .run = [arguments] { return RunLocalize(*arguments); }};
}

}  // namespace qwsm::apps
