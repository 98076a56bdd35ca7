// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/map_to_export.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>

#include "service/io/journal/sqlite_database.hpp"
#include "service/io/logs/journal_reader.hpp"
#include "service/io/maps/map_file.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
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
  if (!fs::exists(folder / "map.yaml")) {
    throw std::runtime_error(folder.string() + ": holds no map.yaml; name " +
                             std::string(kWhatIsTaken));
  }
  MapToExport map{.grid = io::ReadRosMap(folder / "map.yaml"), .paths = {}, .start = {}};
  std::vector<fs::path> folders{folder};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) folders.push_back(entry.path());
  }
  std::ranges::sort(folders);
  for (const fs::path& one : folders) AddPath(one / "trajectory.tum", map);
  return map;
}

OccupancyGrid Rendered(const fs::path& source,
                       std::span<const RelevantScan> scans,
                       const OccupancyGridOptions& rendering) {
  std::optional<OccupancyGrid> grid = RenderOrWarn(scans, rendering);
  if (!grid) throw std::runtime_error(source.string() + ": no map can be drawn of its scans");
  return *std::move(grid);
}

MapToExport LoadSavedMap(const fs::path& file, const OccupancyGridOptions& rendering) {
  const ScanMap saved = io::LoadMap(file);
  MapToExport map{.grid = Rendered(file, saved.scans(), rendering), .paths = {{}}, .start = {}};
  for (const RelevantScan& scan : saved.scans()) {
    map.paths.front().push_back(scan.map_robot.T_a_b);
    if (!map.start) map.start = scan.scan.stamp;
  }
  return map;
}

MapToExport LoadJournal(const fs::path& file, const OccupancyGridOptions& rendering) {
  io::JournalReader journal(file);
  std::vector<RelevantScan> scans;
  std::map<std::string, std::vector<Pose2>> path_of_robot;
  std::optional<Timestamp> start;
  while (const std::optional<io::LogRecord> record = journal.Next()) {
    const auto& reading = std::get<io::ScanReading>(*record);
    const Pose2 T_map_robot = reading.T_odom_robot.value_or(Pose2{});
    scans.push_back({.id = static_cast<ScanId>(scans.size()),
                     .scan = reading.scan,
                     .map_robot = {.T_a_b = T_map_robot}});
    path_of_robot[reading.laser].push_back(T_map_robot);
    start = std::min(start.value_or(Timestamp::max()), reading.scan.stamp);
  }
  for (const io::LogFault& fault : journal.report().faults) {
    messages::Warn("{}: {} ({} times)", file.string(), fault.what, fault.count);
  }
  MapToExport map{.grid = Rendered(file, scans, rendering), .paths = {}, .start = start};
  for (auto& [robot, path] : path_of_robot) map.paths.push_back(std::move(path));
  return map;
}

bool BeginsWith(const fs::path& file, std::string_view magic) {
  std::ifstream stream(file, std::ios::binary);
  std::string beginning(magic.size(), '\0');
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  return stream && beginning == magic;
}

}  // namespace

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
