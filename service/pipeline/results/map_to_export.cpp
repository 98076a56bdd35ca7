// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/map_to_export.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "service/io/journal/sqlite_database.hpp"
#include "service/io/logs/journal_reader.hpp"
#include "service/io/maps/map_file.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "service/pipeline/results/journal_marks.hpp"
#include "service/pipeline/results/marks_list.hpp"
#include "service/pipeline/results/marks_of_map.hpp"
#include "service/pipeline/results/result_file.hpp"
#include "service/pipeline/results/results_writer.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWhatIsTaken =
    "a folder of results with map.yaml, a map of ROS (.yaml), the journal of a service, or a map "
    "saved by qwsm map --save-map";

void AddPath(const fs::path& file, MapToExport& map) {
  if (!fs::exists(file)) return;
  const Trajectory trajectory = io::ReadTumFile(file);
  if (trajectory.empty()) return;
  std::vector<Pose2>& path = map.paths.emplace_back();
  for (const StampedPose2& pose : trajectory) path.push_back(pose.T_map_robot);
  map.start = std::min(map.start.value_or(Timestamp::max()), trajectory.front().stamp);
}

/// The map, and the paths of one robot in the folder itself and of others in folders of their name.
MapToExport LoadResults(const fs::path& folder) {
  if (!fs::exists(folder / ResultFile::kMap)) {
    throw std::runtime_error(folder.string() + ": holds no map.yaml; name " +
                             std::string(kWhatIsTaken));
  }
  MapToExport map{.grid = io::ReadRosMap(folder / ResultFile::kMap), .paths = {}, .start = {}};
  std::vector<fs::path> folders{folder};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) folders.push_back(entry.path());
  }
  std::ranges::sort(folders);
  for (const fs::path& one : folders) AddPath(one / ResultFile::kTrajectory, map);
  const fs::path marks = folder / ResultFile::kMarks;
  if (fs::exists(marks)) map.marks = io::ReadPointsOfInterest(marks);
  return map;
}

MapToExport LoadSavedMap(const fs::path& file, const OccupancyGridOptions& rendering) {
  const ScanMap saved = io::LoadMap(file);
  std::vector<RobotScan> scans;
  for (const RelevantScan& scan : saved.scans()) scans.push_back({.robot = {}, .relevant = scan});
  MapToExport map = MapOfScans(scans, file.string(), rendering);
  map.marks = PointsOf(MarksOfMap(file));
  return map;
}

/// The marks of a journal where its scans are.
std::vector<team::Mark> MarksOfJournal(const fs::path& file) {
  const MarksOnScans kept = ReadMarksOnScans(file);
  return team::PlacedOn(kept.scans, kept.marks);
}

MapToExport LoadJournal(const fs::path& file, const OccupancyGridOptions& rendering) {
  io::JournalReader journal(file);
  std::vector<RobotScan> scans;
  while (std::optional<io::LogRecord> record = journal.Next()) {
    auto& reading = std::get<io::ScanReading>(*record);
    const Pose2 T_map_robot = reading.T_odom_robot.value_or(Pose2{});
    scans.push_back(
        {.robot = std::move(reading.laser),
         .relevant = {.scan = std::move(reading.scan), .map_robot = {.T_a_b = T_map_robot}}});
  }
  for (const io::LogFault& fault : journal.report().faults) {
    messages::Warn("{}: {} ({} times)", file.string(), fault.what, fault.count);
  }
  MapToExport map = MapOfScans(scans, file.string(), rendering);
  map.marks = PointsOf(MarksOfJournal(file));
  return map;
}

bool BeginsWith(const fs::path& file, std::string_view magic) {
  std::ifstream stream(file, std::ios::binary);
  std::string beginning(magic.size(), '\0');
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  return stream && beginning == magic;
}

}  // namespace

MapToExport MapOfScans(const std::vector<RobotScan>& scans,
                       const std::string& name,
                       const OccupancyGridOptions& rendering) {
  std::vector<RelevantScan> relevant;
  std::map<std::string, std::vector<Pose2>> path_of_robot;
  std::optional<Timestamp> start;
  for (const RobotScan& scan : scans) {
    relevant.push_back(scan.relevant);
    path_of_robot[scan.robot].push_back(scan.relevant.map_robot.T_a_b);
    start = std::min(start.value_or(Timestamp::max()), scan.relevant.scan.stamp);
  }
  std::optional<OccupancyGrid> grid = RenderOrWarn(relevant, rendering);
  if (!grid) throw std::runtime_error(name + ": no map can be drawn of its scans");
  MapToExport map{.grid = *std::move(grid), .paths = {}, .start = start};
  for (auto& [robot, path] : path_of_robot) map.paths.push_back(std::move(path));
  return map;
}

MapToExport LoadMapToExport(const fs::path& source, const OccupancyGridOptions& rendering) {
  if (!fs::exists(source)) throw std::runtime_error(source.string() + ": there is no such file");
  if (fs::is_directory(source)) return LoadResults(source);
  if (source.extension() == ".yaml") {
    return {.grid = io::ReadRosMap(source), .paths = {}, .start = {}};
  }
  if (io::IsSqliteDatabase(source)) return LoadJournal(source, rendering);
  if (BeginsWith(source, io::kMapMagic)) return LoadSavedMap(source, rendering);
  throw std::runtime_error(source.string() + ": is none of " + std::string(kWhatIsTaken) +
                           "; of a log, qwsm map makes one");
}

}  // namespace qwsm::pipeline
