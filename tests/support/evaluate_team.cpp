// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How soon and how rightly robots that nobody placed are found in their team's map:
//
//   evaluate_team SCENARIO FIRST_SEED LAST_SEED DURATION_S
//
// The first robot is told where it starts, the others are not. Prints a line for each robot: how
// far it and another one that it was found with had driven, until then, where both had been; how
// far off it was then; and its error afterwards, beside that of a run in which all were told.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "service/config/options_io.hpp"
#include "service/config/scenario_file.hpp"
#include "service/team/service/team_service.hpp"
#include "sim/simulation.hpp"
#include "tests/support/parted_drive.hpp"

namespace qwsm::team {
namespace {

// So near to where another robot has been a robot sees what that one saw.
constexpr double kInCommon_m = 1.5;
// The place where a robot is found is wrong if it is farther off.
constexpr double kWrong_m = 0.5;

std::string NameOf(std::size_t robot) { return "robot" + std::to_string(robot + 1); }

/// The last answer to each robot.
class LastAnswers : public TeamSink {
 public:
  void TakeAnswer(const RobotAnswer& answer) override {
    last_.insert_or_assign(answer.robot, answer);
  }
  const RobotAnswer& Of(const std::string& robot) const { return last_.at(robot); }

 private:
  std::map<std::string, RobotAnswer> last_;
};

/// What becomes of one robot.
struct Fate {
  std::vector<Eigen::Vector2d> path_world_m;
  double way_m = 0.0;
  std::map<std::size_t, double> in_common_m;  // With other robots, while they were apart.
  double found_in_common_m = 0.0;  // The most of those with whom it was found, or is not.
  bool is_found = false;
  double found_off_m = 0.0;
  std::vector<std::size_t> steps;  // When it was in the team's map.
  std::vector<double> errors_m;
};

sim::ScenarioOptions Scenario(const std::string& name, int seed, const std::string& duration) {
  return config::LoadOptions<sim::ScenarioOptions>(
      {.file = config::FindScenario(name),
       .settings = {"seed=" + std::to_string(seed), "duration_s=" + duration}});
}

// A scenario, or one drive in parts.
std::vector<sim::Reading> Drive(const std::string& drive, int seed, const std::string& duration) {
  const std::size_t at = drive.find('@');
  if (at != std::string::npos) {
    const std::string whole = drive.substr(0, at);
    const int robots = std::stoi(drive.substr(at + 1));
    return std::filesystem::exists(whole)
               ? test::PartedLog(whole, robots)
               : test::PartedDrive(Scenario(whole, seed, duration), robots);
  }
  sim::Simulation simulation(Scenario(drive, seed, duration));
  std::vector<sim::Reading> readings;
  while (std::optional<sim::Reading> reading = simulation.Next()) {
    readings.push_back(std::move(*reading));
  }
  return readings;
}

bool WasNear(const Fate& other, const Eigen::Vector2d& p_m) {
  return std::ranges::any_of(other.path_world_m, [&](const Eigen::Vector2d& there_m) {
    return (there_m - p_m).norm() < kInCommon_m;
  });
}

class Trial {
 public:
  explicit Trial(bool tells_starts)
      : tells_starts_(tells_starts), service_(Options(), SinkList<TeamSink>(answers_)) {
    service_.Start();
  }

  void Take(const sim::Reading& reading, std::size_t step) {
    const std::string robot = NameOf(reading.robot);
    const bool is_first = !fates_.contains(reading.robot);
    Fate& fate = fates_[reading.robot];
    if (is_first && (reading.robot == 0 || tells_starts_)) {
      service_.robots().PlaceAt(robot,
                                UncertainPose2::WithSigmas(reading.T_world_robot, 1e-3, 1e-3));
    }
    service_.robots().TakeOdometry(robot, reading.scan.stamp, reading.T_odom_robot);
    service_.robots().TakeScan(robot, reading.scan);
    service_.WaitUntilIdle();
    Follow(reading, step, fate);
  }

  const std::map<std::size_t, Fate>& fates() const { return fates_; }

 private:
  static TeamServiceOptions Options() {
    TeamServiceOptions options;
    options.team.threads = 1;
    options.team.map_period_s = 0.0;
    options.merges_beside = false;
    return options;
  }

  void Follow(const sim::Reading& reading, std::size_t step, Fate& fate) {
    const Eigen::Vector2d p_m = reading.T_world_robot.translation_m();
    const double way_m = fate.path_world_m.empty() ? 0.0 : (p_m - fate.path_world_m.back()).norm();
    fate.path_world_m.push_back(p_m);
    fate.way_m += way_m;
    component_[reading.robot] = answers_.Of(NameOf(reading.robot)).component;
    for (auto& [other, of_other] : fates_) {
      if (component_[other] == component_[reading.robot] || !WasNear(of_other, p_m)) continue;
      fate.in_common_m[other] += way_m;
      of_other.in_common_m[reading.robot] += way_m;
    }
    if (!component_[reading.robot].empty()) {
      for (const auto& [other, with_m] : fate.in_common_m) {
        fate.found_in_common_m = std::max(fate.found_in_common_m, with_m);
      }
      return;
    }
    const Pose2 error =
        reading.T_world_robot.Inverse() * answers_.Of(NameOf(reading.robot)).step.map_robot.T_a_b;
    if (!std::exchange(fate.is_found, true)) {
      fate.found_off_m = error.translation_m().norm();
      fate.found_in_common_m = MostInCommon(fate);
    }
    fate.steps.push_back(step);
    fate.errors_m.push_back(error.translation_m().norm());
  }

  double MostInCommon(const Fate& fate) const {
    double most_m = 0.0;
    for (const auto& [other, way_m] : fate.in_common_m) {
      if (component_.at(other).empty()) most_m = std::max(most_m, way_m);
    }
    return most_m;
  }

  const bool tells_starts_;
  LastAnswers answers_;
  TeamService service_;
  std::map<std::size_t, Fate> fates_;
  std::map<std::size_t, std::string> component_;
};

double Rms(const std::vector<double>& errors_m) {
  double sum = 0.0;
  for (const double error_m : errors_m) sum += error_m * error_m;
  return errors_m.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(errors_m.size()));
}

/// Of the same steps as in the other trial.
double RmsAt(const Fate& fate, const std::vector<std::size_t>& steps) {
  std::vector<double> errors_m;
  for (std::size_t i = 0; i < fate.steps.size(); ++i) {
    if (std::ranges::binary_search(steps, fate.steps[i])) errors_m.push_back(fate.errors_m[i]);
  }
  return Rms(errors_m);
}

struct Sum {
  int robots = 0;
  int found = 0;
  int in_time = 0;
  int with_enough_in_common = 0;
  int wrong = 0;
};

void Print(int seed, std::size_t robot, const Fate& fate, const Fate& told, Sum& sum) {
  constexpr double kInTime_m = 10.0;
  const bool is_wrong = fate.is_found && fate.found_off_m > kWrong_m;
  const bool had_time = fate.is_found || fate.found_in_common_m > kInTime_m;
  ++sum.robots;
  sum.found += fate.is_found;
  sum.with_enough_in_common += had_time;
  sum.in_time += fate.is_found && fate.found_in_common_m <= kInTime_m;
  sum.wrong += is_wrong;
  std::printf("%d %s: drove %.1f m, %.1f m in common, %s, %.3f m off; rms %.4f m, told %.4f m%s\n",
              seed,
              NameOf(robot).c_str(),
              fate.way_m,
              fate.found_in_common_m,
              fate.is_found ? "found" : "apart",
              fate.found_off_m,
              Rms(fate.errors_m),
              RmsAt(told, fate.steps),
              is_wrong ? " WRONG" : "");
  std::fflush(stdout);
}

void Evaluate(const std::string& scenario, int seed, const std::string& duration, Sum& sum) {
  const std::vector<sim::Reading> readings = Drive(scenario, seed, duration);
  Trial unknown(false);
  Trial told(true);
  for (std::size_t step = 0; step < readings.size(); ++step) {
    unknown.Take(readings[step], step);
    told.Take(readings[step], step);
  }
  for (const auto& [robot, fate] : unknown.fates()) {
    if (robot > 0) Print(seed, robot, fate, told.fates().at(robot), sum);
  }
}

}  // namespace
}  // namespace qwsm::team

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: evaluate_team SCENARIO FIRST_SEED LAST_SEED DURATION_S\n");
    return 2;
  }
  qwsm::team::Sum sum;
  for (int seed = std::atoi(argv[2]); seed <= std::atoi(argv[3]); ++seed) {
    qwsm::team::Evaluate(argv[1], seed, argv[4], sum);
  }
  std::printf("%s: %d robots, %d found, %d wrong; %d of %d within 10 m in common\n",
              argv[1],
              sum.robots,
              sum.found,
              sum.wrong,
              sum.in_time,
              sum.with_enough_in_common);
  return sum.wrong == 0 ? 0 : 1;
}
