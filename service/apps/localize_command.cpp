// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/geometry/angle.hpp"
#include "qwsm/geometry/position.hpp"
#include "qwsm/mapping/localizer.hpp"
#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/apps/number_arguments.hpp"
#include "service/apps/run_session.hpp"
#include "service/apps/saved_map.hpp"

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

/// Where the robot is at its first scan, if that was said.
std::optional<UncertainPose2> StartOf(const LocalizeArguments& arguments) {
  const std::vector<double>& at = arguments.at;
  if (at.empty()) return std::nullopt;
  constexpr double kSigma_m = 0.1;
  const double kSigma_rad = DegreesToRadians(3.0);
  return UncertainPose2::WithSigmas(
      {at[0], at[1], NormalizeAngle(DegreesToRadians(at[2]))}, kSigma_m, kSigma_rad);
}

ExitCode RunLocalize(LocalizeArguments arguments) {
  StartMessages(arguments.run.verbosity);
  arguments.run.other_inputs = {arguments.map};
  KnownMap known = OpenMap(arguments.map);
  const options::ProgramOptions options = LoadOptionsFor(arguments, known.map);
  const auto source = OpenLogs(arguments.run, options.log);
  if (arguments.run.dry_run) return TellPlan("localize", arguments.run);

  const RunSession session(arguments.run, options);
  Localizer localizer(options.mapper, std::move(known.map), StartOf(arguments));
  pipeline::JournalMarks marks(arguments.run.logs, known.marks);
  return FollowInMap("localize", {localizer, marks}, *source, options, session);
}

}  // namespace

Command AddLocalizeCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "localize", "the robot's path in a map that was saved");
  auto arguments = std::make_shared<LocalizeArguments>();
  parser->footer(
      "  qwsm map monday.log --save-map site.qwsm\n"
      "  qwsm localize --map site.qwsm tuesday.log                 finds out where it starts\n"
      "  qwsm localize --map site.qwsm tuesday.log --at 3 -1.5 90  is told so\n"
      "  qwsm localize --map site.yaml tuesday.log                 in a map of ROS map_server");
  parser->add_option("--map", arguments->map, "saved by qwsm map --save-map, or a map.yaml of ROS")
      ->required()
      ->type_name("MAP");
  parser->add_option("--at", arguments->at, "where the robot starts: metres and degrees")
      ->expected(3)
      ->check(NumberBetween(-kFarthestCoordinate_m, kFarthestCoordinate_m))
      ->type_name("X Y DEG");
  AddRunArguments(*parser, arguments->run);
  AddNoPictures(*parser, arguments->run.no_pictures);
  AddRobot(*parser, arguments->run.sources);
  return {.parser = parser, .run = [arguments] { return RunLocalize(*arguments); }};
}

}  // namespace qwsm::apps
