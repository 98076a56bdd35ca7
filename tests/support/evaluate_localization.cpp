// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// evaluate_localization LOG [STARTS [SEED [CELL_M]]]: puts a robot down at random scans of one half
// of a recording and has it found in the map of the other half. The recording is cut into twenty
// parts that go to the two halves in turns; poses, of the map and the true ones, are those of the
// whole recording once its loops are closed. Two groups of starts: in the mapped part (within 1.5 m
// of where the robot was when it mapped, for as long as it is looked for), and far from it (more
// than 8 m away), where nothing is to be found. With CELL_M, the map is an occupancy grid of such
// cells.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/logs/log_reader.hpp"
#include "qwsm/mapping/grid_survey.hpp"
#include "qwsm/mapping/localizer.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"

namespace {

using namespace qwsm;

constexpr std::size_t kParts = 20;
constexpr double kSearch_m = 5.0;  // The robot drives on for so far.
constexpr double kInMap_m = 1.5;
constexpr double kFar_m = 8.0;
constexpr double kRight_m = 0.5;
constexpr double kRight_rad = 0.15;

/// A recording, its true path and the map of one half.
struct Recording {
  std::vector<Observation> observations;
  std::vector<Pose2> T_map_robot;
  std::vector<double> to_map_m;  ///< From the nearest scan that the map was made of.
  ScanMap map;

  bool IsOfMap(std::size_t scan) const { return scan * kParts / observations.size() % 2 == 0; }
};

Recording Read(const std::string& path) {
  Recording recording;
  SelfCorrectingMapper mapper;
  std::vector<std::pair<std::size_t, LaserScan>> relevant;
  const auto log = io::OpenLog(path);
  while (const auto record = log->Next()) {
    const auto* reading = std::get_if<io::ScanReading>(&*record);
    if (reading == nullptr) continue;
    recording.observations.push_back(
        {.scan = reading->scan, .T_odom_robot = reading->T_odom_robot});
    const MappingStep step = mapper.Process(recording.observations.back());
    if (step.relevant) {
      relevant.emplace_back(recording.observations.size() - 1, step.relevant_scan);
    }
  }
  const Correction correction = mapper.Correct();
  for (const UncertainPose2& map_robot : correction.map_robot) {
    recording.T_map_robot.push_back(map_robot.T_a_b);
  }
  for (const auto& [scan, points] : relevant) {
    if (!recording.IsOfMap(scan)) continue;
    recording.map.Insert(points, ToPoints(points), correction.map_robot[scan]);
  }
  return recording;
}

/// The same place as another program hands it over: free and occupied cells.
void MakeForeign(Recording& recording, double cell_m) {
  const OccupancyGridResult drawn = RenderOccupancyGrid(recording.map.scans(), {.cell_m = cell_m});
  if (drawn.status != RenderStatus::kRendered) throw std::invalid_argument("the map has no grid");
  recording.map = SurveyGrid(drawn.grid);
}

void MeasureDistances(Recording& recording) {
  for (const Pose2& T_map_robot : recording.T_map_robot) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const RelevantScan& scan : recording.map.scans()) {
      const Eigen::Vector2d apart_m =
          scan.map_robot.T_a_b.translation_m() - T_map_robot.translation_m();
      nearest_m = std::min(nearest_m, apart_m.norm());
    }
    recording.to_map_m.push_back(nearest_m);
  }
}

double ProcessorTime_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Outcome {
  PlaceVerdict verdict = PlaceVerdict::kNotFound;
  bool is_right = false;  ///< Of the first place.
  double way_m = 0.0;
  double processor_s = 0.0;
  bool stayed_in_map = true;
};

bool IsRight(const Pose2& found, const Pose2& truth) {
  return (found.translation_m() - truth.translation_m()).norm() < kRight_m &&
         std::abs(NormalizeAngle(found.theta_rad - truth.theta_rad)) < kRight_rad;
}

Outcome PutDownAt(const Recording& recording, std::size_t start) {
  MapperOptions options;
  options.extend_map = false;
  Localizer localizer(options, recording.map);
  Outcome outcome;
  const double begin_s = ProcessorTime_s();
  std::optional<Pose2> T_map_last;
  for (std::size_t i = start; i < recording.observations.size() && outcome.way_m < kSearch_m; ++i) {
    const Pose2& truth = recording.T_map_robot[i];
    if (T_map_last) {
      outcome.way_m += (truth.translation_m() - T_map_last->translation_m()).norm();
    }
    T_map_last = truth;
    if (recording.to_map_m[i] > kInMap_m) outcome.stayed_in_map = false;
    const MappingStep step = localizer.Process(recording.observations[i]);
    outcome.verdict = localizer.belief().verdict;
    if (!localizer.is_lost()) {
      outcome.verdict = PlaceVerdict::kFound;
      outcome.is_right = IsRight(step.map_robot.T_a_b, truth);
      break;
    }
  }
  outcome.processor_s = ProcessorTime_s() - begin_s;
  return outcome;
}

/// Starts of one group and what became of them.
struct Group {
  std::string name;
  std::vector<std::size_t> starts;
  int tried = 0;
  int right = 0;
  int wrong = 0;
  int one_of_these = 0;
  double way_m = 0.0;
  double processor_s = 0.0;
  double longest_s = 0.0;

  void Count(const Outcome& outcome) {
    ++tried;
    right += outcome.is_right ? 1 : 0;
    wrong += outcome.verdict == PlaceVerdict::kFound && !outcome.is_right ? 1 : 0;
    one_of_these += outcome.verdict == PlaceVerdict::kOneOfThese ? 1 : 0;
    if (outcome.is_right) way_m += outcome.way_m;
    processor_s += outcome.processor_s;
    longest_s = std::max(longest_s, outcome.processor_s);
  }

  void Print() const {
    if (tried == 0) return;
    std::cout << name << ": " << tried << " starts, right " << right << ", wrong " << wrong
              << ", one of several " << one_of_these << ", not found "
              << tried - right - wrong - one_of_these << "; found after "
              << way_m / std::max(1, right) << " m; processor " << processor_s / tried
              << " s, longest " << longest_s << " s\n";
  }
};

void Evaluate(const std::string& path, int starts, std::uint64_t seed, double cell_m) {
  Recording recording = Read(path);
  MeasureDistances(recording);
  if (cell_m > 0.0) MakeForeign(recording, cell_m);
  Group mapped{.name = "in the mapped part", .starts = {}};
  Group unmapped{.name = "far from it", .starts = {}};
  for (std::size_t i = 0; i < recording.observations.size(); ++i) {
    if (recording.IsOfMap(i)) continue;
    if (recording.to_map_m[i] < kInMap_m) mapped.starts.push_back(i);
    if (recording.to_map_m[i] > kFar_m) unmapped.starts.push_back(i);
  }
  std::mt19937_64 random(seed);
  for (Group* group : {&mapped, &unmapped}) {
    while (group->tried < starts && !group->starts.empty()) {
      const std::size_t next = random() % group->starts.size();
      const Outcome outcome = PutDownAt(recording, group->starts[next]);
      group->starts.erase(group->starts.begin() + static_cast<std::ptrdiff_t>(next));
      // Who is not found because the recording ends, or because it leaves the map, does not count.
      const bool is_cut_short = outcome.verdict != PlaceVerdict::kFound && group == &mapped &&
                                (!outcome.stayed_in_map || outcome.way_m < kSearch_m);
      if (!is_cut_short) group->Count(outcome);
    }
    group->Print();
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw std::invalid_argument("no log");
    Evaluate(argv[1],
             argc > 2 ? std::stoi(argv[2]) : 100,
             argc > 3 ? std::stoull(argv[3]) : 1,
             argc > 4 ? std::stod(argv[4]) : 0.0);
  } catch (const std::exception& error) {
    std::cerr << "evaluate_localization: " << error.what()
              << "\nusage: evaluate_localization LOG [STARTS [SEED [CELL_M]]]\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
