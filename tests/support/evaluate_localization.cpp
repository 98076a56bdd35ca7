// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Puts robots down at random scans of one half of a drive and has them found in the map of the
// other half; kUsage says how. Two groups of starts: in the mapped part (within 1.5 m of where the
// robot was when it mapped, for as long as it is looked for), and far from it (more than 8 m away),
// where nothing is to be found.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/mapping/localizer.hpp"
#include "tests/support/halved_recording.hpp"

namespace {

using namespace qwsm;
using namespace qwsm::test;

constexpr const char* kUsage =
    R"(usage: evaluate_localization STARTS SEED MAP...

Each MAP is a recorded log, or `corridor`, `office` or `alike`: simulated drives, the last one through
1.5 km of corridors of which each leg is like the next but one. With `@0.05` behind it the map is an
occupancy grid of cells of 0.05 m. Prints a row of a table (Markdown) for each map and group of starts:
how many were found where they are, or elsewhere; answered with 'one of these' (in brackets: the true
place among them); not found; after how many metres they were found, and the processor time of all
looks of a start.
)";

constexpr double kSearch_m = 5.0;  // The robot drives on for so far.
constexpr double kInMap_m = 1.5;
constexpr double kFar_m = 8.0;
constexpr double kRight_m = 0.5;
constexpr double kRight_rad = 0.15;

double ProcessorTime_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool IsRight(const Pose2& found, const Pose2& truth) {
  return (found.translation_m() - truth.translation_m()).norm() < kRight_m &&
         std::abs(NormalizeAngle(found.theta_rad - truth.theta_rad)) < kRight_rad;
}

struct Outcome {
  PlaceVerdict verdict = PlaceVerdict::kNotFound;
  bool is_right = false;  ///< Whether the robot is at the place found, or at one of these.
  double way_m = 0.0;
  double processor_s = 0.0;
  bool stayed_in_map = true;
};

/// The drives of robots that are put down in a map.
class Trials {
 public:
  explicit Trials(HalvedRecording recording)
      : recording_(std::move(recording)), to_map_m_(recording_.DistancesToMap_m()) {}

  /// Scans of the other half at these distances from the mapped path.
  std::vector<std::size_t> StartsBetween(double least_m, double most_m) const {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < to_map_m_.size(); ++i) {
      if (recording_.is_of_map[i] || to_map_m_[i] < least_m || to_map_m_[i] > most_m) continue;
      starts.push_back(i);
    }
    return starts;
  }

  Outcome PutDownAt(std::size_t start) const {
    MapperOptions options;
    options.extend_map = false;
    Localizer localizer(options, recording_.map);
    Outcome outcome;
    Pose2 T_map_last = recording_.T_map_robot[start];
    Pose2 T_map_look = T_map_last;
    int looks = 0;
    for (std::size_t i = start; i < recording_.observations.size() && outcome.way_m < kSearch_m;
         ++i) {
      const Pose2& truth = recording_.T_map_robot[i];
      outcome.way_m += (truth.translation_m() - T_map_last.translation_m()).norm();
      T_map_last = truth;
      if (to_map_m_[i] > kInMap_m) outcome.stayed_in_map = false;
      const double begin_s = ProcessorTime_s();
      const MappingStep step = localizer.Process(recording_.observations[i]);
      outcome.processor_s += ProcessorTime_s() - begin_s;
      if (!localizer.is_lost()) {
        outcome.verdict = PlaceVerdict::kFound;
        outcome.is_right = IsRight(step.map_robot.T_a_b, truth);
        return outcome;
      }
      if (std::exchange(looks, localizer.belief().looks) != looks) T_map_look = truth;
    }
    outcome.verdict = localizer.belief().verdict;
    if (outcome.verdict == PlaceVerdict::kOneOfThese) {
      outcome.is_right = std::ranges::any_of(localizer.belief().places, [&](const Place& place) {
        return IsRight(place.map_robot.T_a_b, T_map_look);
      });
    }
    return outcome;
  }

 private:
  HalvedRecording recording_;
  std::vector<double> to_map_m_;
};

/// What became of the starts of one group.
struct Summary {
  int starts = 0;
  int right = 0;
  int wrong = 0;
  int one_of_these = 0;
  int one_of_these_right = 0;
  double way_m = 0.0;
  double processor_s = 0.0;
  double longest_s = 0.0;

  void Count(const Outcome& outcome) {
    const bool is_found = outcome.verdict == PlaceVerdict::kFound;
    const bool is_one = outcome.verdict == PlaceVerdict::kOneOfThese;
    ++starts;
    right += is_found && outcome.is_right ? 1 : 0;
    wrong += is_found && !outcome.is_right ? 1 : 0;
    one_of_these += is_one ? 1 : 0;
    one_of_these_right += is_one && outcome.is_right ? 1 : 0;
    if (is_found) way_m += outcome.way_m;
    processor_s += outcome.processor_s;
    longest_s = std::max(longest_s, outcome.processor_s);
  }

  std::string Row(const std::string& name) const {
    return fmt::format("| {} | {} | {} | {} | {} ({}) | {} | {:.1f} m | {:.2f} s | {:.2f} s |\n",
                       name,
                       starts,
                       right,
                       wrong,
                       one_of_these,
                       one_of_these_right,
                       starts - right - wrong - one_of_these,
                       way_m / std::max(1, right + wrong),
                       processor_s / std::max(1, starts),
                       longest_s);
  }
};

/// Tries so many of the starts, by chance. Of those in the map, whoever is not found because the
/// recording ends, or because it leaves the map, does not count.
Summary TrySome(const Trials& trials,
                std::vector<std::size_t> among,
                int starts,
                std::uint64_t seed,
                bool are_in_map) {
  std::mt19937_64 random(seed);
  Summary summary;
  while (summary.starts < starts && !among.empty()) {
    const std::size_t next = random() % among.size();
    const Outcome outcome = trials.PutDownAt(among[next]);
    among.erase(among.begin() + static_cast<std::ptrdiff_t>(next));
    const bool is_cut_short = outcome.verdict != PlaceVerdict::kFound &&
                              (!outcome.stayed_in_map || outcome.way_m < kSearch_m);
    if (!are_in_map || !is_cut_short) summary.Count(outcome);
  }
  return summary;
}

HalvedRecording Recording(const std::string& map) {
  if (map == "corridor") return HalvedDrive(CorridorThereAndBack());
  if (map == "office") return HalvedDrive(OfficeTwice());
  if (map == "alike") return HalvedDrive(AlikeCorridors());
  return HalvedLog(map);
}

void Evaluate(const std::string& map, int starts, std::uint64_t seed) {
  const std::size_t at = map.find('@');
  const std::string drive = map.substr(0, at);
  HalvedRecording recording = Recording(drive);
  if (at != std::string::npos) MakeForeign(recording, std::stod(map.substr(at + 1)));
  const Trials trials(std::move(recording));
  const std::string name =
      std::filesystem::path(drive).filename().string() + map.substr(drive.size());
  const auto print = [&](const std::string& group, const Summary& summary) {
    if (summary.starts > 0) std::cout << summary.Row(name + group) << std::flush;
  };
  print("", TrySome(trials, trials.StartsBetween(0.0, kInMap_m), starts, seed, true));
  constexpr double kAnywhere_m = std::numeric_limits<double>::infinity();
  print(", far", TrySome(trials, trials.StartsBetween(kFar_m, kAnywhere_m), starts, seed, false));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 4) throw std::invalid_argument("too few arguments");
    std::cout << "| map | starts | right | wrong | one of these | not found | after | processor | "
                 "longest |\n|---|---|---|---|---|---|---|---|---|\n";
    for (int i = 3; i < argc; ++i) Evaluate(argv[i], std::stoi(argv[1]), std::stoull(argv[2]));
  } catch (const std::exception& error) {
    std::cerr << "evaluate_localization: " << error.what() << '\n' << kUsage;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
