// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <iomanip>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/network.hpp"
#include "service/apps/output.hpp"
#include "service/dds/robot/mark_reader.hpp"
#include "service/io/rescue/geotiff_file.hpp"
#include "service/io/rescue/points_of_interest.hpp"
#include "service/io/rescue/rescue_map.hpp"
#include "service/pipeline/network/team_listener.hpp"
#include "service/pipeline/results/map_to_export.hpp"
#include "service/pipeline/results/marks_list.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/team/marks/mark_book.hpp"

namespace qwsm::apps {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::optional<fs::path> source;
  bool live = false;  ///< Whether the map is that of the services on the network.
  fs::path geotiff;
  std::optional<fs::path> points;
  std::string team;
  std::string country;
  std::string mission;
  std::optional<std::string> start;
  int px_per_cell = 1;
  double searched_m = 0.0;  ///< How far victims are found from a robot; 0: nothing was searched.
  NetworkArguments network;
};

/// Day and time of a stamp, in UTC.
std::pair<std::string, std::string> DayAndTime(Timestamp stamp) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(stamp).count();
  const std::tm utc = fmt::gmtime(static_cast<std::time_t>(seconds));
  return {fmt::format("{:%Y-%m-%d}", utc), fmt::format("{:%H:%M:%S}", utc)};
}

io::MissionTitle TitleOf(const ExportArguments& arguments, const std::optional<Timestamp>& start) {
  io::MissionTitle title{.team = arguments.team,
                         .country = arguments.country,
                         .date = {},
                         .time = {},
                         .mission = arguments.mission};
  if (arguments.start) {
    const std::size_t gap = arguments.start->find(' ');
    title.date = arguments.start->substr(0, gap);
    title.time = arguments.start->substr(gap + 1);
  } else if (start) {
    std::tie(title.date, title.time) = DayAndTime(*start);
  }
  return title;
}

/// The check() of an option that takes a day and a time.
CLI::Validator DayAndTimeOfDay() {
  const auto objection = [](const std::string& text) -> std::string {
    std::tm parsed{};
    std::istringstream stream(text);
    stream >> std::get_time(&parsed, "%Y-%m-%d %H:%M:%S");
    if (stream && stream.peek() == std::istringstream::traits_type::eof()) return {};
    return "must be a day and a time as in '2026-07-04 10:15:00', got '" + text + "'";
  };
  return {objection, ""};
}

/// The name of the files, with another ending.
fs::path Beside(const fs::path& name, const std::string& ending) {
  fs::path base = name;
  if (base.extension() == ".tif" || base.extension() == ".tiff") base.replace_extension();
  return base.string() + ending;
}

void WarnOfMarksOutside(const io::RescueScene& scene, const io::GeoPicture& picture) {
  for (const io::PointOfInterest& point : scene.points) {
    const Eigen::Vector2d at_px = picture.ToPixel(point.p_map_m.head<2>());
    const bool is_inside = at_px.minCoeff() >= 0.0 && at_px.x() < picture.image.width_px &&
                           at_px.y() < picture.image.height_px;
    if (is_inside) continue;
    messages::Warn("point {} at {:.2f} {:.2f} lies outside of the map and is not drawn",
                   point.id,
                   point.p_map_m.x(),
                   point.p_map_m.y());
  }
}

/// The map of all that services on the network share.
pipeline::MapToExport HearMap(const options::ProgramOptions& options) {
  const dds::Participant participant(options.network);
  const dds::MarkReader marks(participant);
  const pipeline::Interruption interruption;
  std::vector<pipeline::RobotScan> scans;
  for (team::TeamScan& scan :
       pipeline::HearTeamScans(participant, [&] { return interruption.requested(); })) {
    scans.push_back({.robot = scan.key.robot,
                     .relevant = {.scan = std::move(scan.scan), .map_robot = scan.map_robot}});
  }
  if (scans.empty())
    throw UsageError("no service on the network shares a map: is qwsm serve running?");
  pipeline::MapToExport map = pipeline::MapOfScans(scans, "the services' map", options.rendering);
  team::MarkBook book;
  for (const team::Mark& mark : marks.Take()) book.Take(mark);
  map.marks = pipeline::PointsOf(book.marks());
  return map;
}

ExitCode RunExport(const ExportArguments& arguments) {
  const NetworkSession session(arguments.network);
  if (arguments.live == arguments.source.has_value()) {
    throw UsageError("export needs either a SOURCE or --live");
  }
  if (!arguments.geotiff.has_filename()) {
    throw UsageError("--geotiff needs a name for the files, as rescue or folder/rescue");
  }
  std::vector<io::PointOfInterest> given;
  if (arguments.points) given = io::ReadPointsOfInterest(*arguments.points);
  const options::ProgramOptions& options = session.options();
  pipeline::MapToExport map = arguments.live
                                  ? HearMap(options)
                                  : pipeline::LoadMapToExport(*arguments.source, options.rendering);

  std::vector<io::PointOfInterest> points = std::move(map.marks);
  std::ranges::move(given, std::back_inserter(points));
  const fs::path tiff = Beside(arguments.geotiff, ".tif");
  const io::RescueScene scene{.grid = map.grid,
                              .paths = std::move(map.paths),
                              .points = std::move(points),
                              .name = tiff.filename().string(),
                              .px_per_cell = arguments.px_per_cell,
                              .searched_m = arguments.searched_m};
  const io::GeoPicture picture = io::DrawRescueMap(scene);
  WarnOfMarksOutside(scene, picture);
  io::WriteGeoTiff(tiff, picture);
  io::WriteWorldFile(Beside(arguments.geotiff, ".tfw"), picture);
  const fs::path list = Beside(arguments.geotiff, "_pois.csv");
  io::WritePointsOfInterest(list, TitleOf(arguments, map.start), scene.points);
  if (arguments.network.verbosity.quiet) return ExitCode::kDone;
  Print("{} x {} pixels of {:g} m into {}; {} points of interest into {}\n",
        picture.image.width_px,
        picture.image.height_px,
        picture.pixel_m,
        tiff.string(),
        scene.points.size(),
        list.string());
  return ExitCode::kDone;
}

void AddTitleArguments(CLI::App& parser, ExportArguments& arguments) {
  constexpr const char* kTitle = "What the list of points of interest begins with";
  parser.add_option("--team", arguments.team, "name of the team")->type_name("TEXT")->group(kTitle);
  parser.add_option("--country", arguments.country, "of the team")
      ->type_name("TEXT")
      ->group(kTitle);
  parser.add_option("--mission", arguments.mission, "name of the mission")
      ->type_name("TEXT")
      ->group(kTitle);
  parser
      .add_option("--start",
                  arguments.start,
                  "day and time of its start, '2026-07-04 10:15:00'; else of the first scan, UTC")
      ->check(DayAndTimeOfDay())
      ->type_name("TIME")
      ->group(kTitle);
}

}  // namespace

Command AddExportCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "export", "a map as rescue teams hand it over (GeoTIFF)");
  auto arguments = std::make_shared<ExportArguments>();
  parser->footer(
      "  qwsm export results/latest --geotiff rescue              rescue.tif, .tfw, "
      "rescue_pois.csv\n"
      "  qwsm export results/latest --geotiff rescue --pois marks.csv\n"
      "  qwsm export team.journal --geotiff rescue                of a service, running or not\n"
      "  qwsm export --live --geotiff rescue                      of services on the network\n"
      "  qwsm export site.qwsm --geotiff site --set rendering.cell_m=0.02\n"
      "  qwsm export results/latest --geotiff rescue --searched 1.5   and what was searched\n"
      "marks.csv is a table with commas: its first line names the columns, of which x, y (metres)\n"
      "and type (victim, hazard, else an object) are needed; id, time, text, z, robot, mode are "
      "not.");
  parser
      ->add_option("SOURCE",
                   arguments->source,
                   "folder of results, journal of a service, saved map, or map of ROS (.yaml)")
      ->type_name("");
  parser
      ->add_option("--geotiff",
                   arguments->geotiff,
                   "write NAME.tif, NAME.tfw and NAME_pois.csv as the RoboCup Rescue rules say")
      ->required()
      ->type_name("NAME");
  parser->add_flag("--live", arguments->live, "the map that services on the network have now");
  parser
      ->add_option("--pois", arguments->points, "points of interest, besides what operators marked")
      ->type_name("FILE");
  parser
      ->add_option("--pixels-per-cell",
                   arguments->px_per_cell,
                   "to a side; 3 makes the numbers of marks easy to read")
      ->check(CLI::Range(1, 10))
      ->capture_default_str()
      ->type_name("N");
  parser
      ->add_option("--searched",
                   arguments->searched_m,
                   "metres from a robot's path in which victims would have been found, drawn green")
      ->check(CLI::Range(0.0, 100.0))
      ->type_name("METRES");
  AddTitleArguments(*parser, *arguments);
  AddNetworkArguments(*parser, arguments->network, "");
  return {.parser = parser, .run = [arguments] { return RunExport(*arguments); }};
}

}  // namespace qwsm::apps
