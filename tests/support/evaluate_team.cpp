// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How soon and how rightly robots of which nobody knows where they are are found in their team's
// map:
//
//   evaluate_team SCENARIO FIRST_SEED LAST_SEED DURATION_S
//
// SCENARIO is team, or what one of its variants is called after that: unknown, wrong, late,
// carried, wings, corridor, campus; or a file. Robots are told where they start as the scenario has
// it. A scenario or a recorded log with `@3` behind it is one drive in three parts, each driven by
// another robot at the same time, of which only the first one is told where it starts. Prints a
// line for each robot that was apart or astray for a while: how far it had driven, until it was
// found, where the robots that it was found with had been; how far off it was then,
// and how far it had drifted in its own component, which no place of that can mend; how many of its
// answers in the team's map were farther off than half a metre; and its error in that map, beside
// that of a run in which all were told rightly. And one for the team: how wrong its map and all
// answers in it are, wherever the map lies in the world (ATE, Sturm et al. 2012), beside that of
// that run.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/metrics/trajectory_error.hpp"
#include "service/config/options_io.hpp"
#include "service/config/scenario_file.hpp"
#include "service/team/service/team_service.hpp"
#include "sim/simulation.hpp"
#include "tests/support/parted_drive.hpp"

namespace qwsm::team {
namespace {

// So near to where another robot has been a robot sees what that one saw.
constexpr double kInCommon_m = 1.5;
// The place where a robot is found is wrong if it is farther off than it drifted, and so much.
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
  bool was_apart = false;
  bool is_apart = false;
  int times_lost = 0;
  double found_off_m = 0.0;     // The worst time.
  double beyond_drift_m = 0.0;  // Likewise.
  double drifted_m = 0.0;       // While it is apart, in the component that it is in.
  std::string apart_in;
  Pose2 T_apart_world;                    // When that began.
  bool is_beside_others_wrongly = false;  // In a component that is not the team's map.
  std::vector<std::size_t> steps;         // When it was in the team's map.
  std::vector<double> errors_m;
  std::vector<PosePair> answers;  // Likewise.
};

/// What robots measure, and what they say of where they start.
struct Drive {
  std::vector<sim::RobotOptions> robots;
  std::vector<sim::Reading> readings;
};

// The variants of `team` are known by what is special of them, too.
std::string FileOf(const std::string& scenario) {
  if (scenario == "team" || scenario.find('.') != std::string::npos) return scenario;
  return "team_" + scenario;
}

sim::ScenarioOptions Load(const std::string& scenario, int seed, const std::string& duration) {
  return config::LoadOptions<sim::ScenarioOptions>(
      {.file = config::FindScenario(scenario),
       .settings = {"seed=" + std::to_string(seed), "duration_s=" + duration}});
}

Drive DriveOf(const sim::ScenarioOptions& scenario) {
  sim::Simulation simulation(scenario);
  Drive drive{.robots = scenario.robots, .readings = {}};
  while (std::optional<sim::Reading> reading = simulation.Next()) {
    drive.readings.push_back(std::move(*reading));
  }
  return drive;
}

// Of the robots that drive a part each only the first one says where it starts.
Drive PartsOf(const std::string& whole, int robots, int seed, const std::string& duration) {
  Drive drive{.robots = std::vector<sim::RobotOptions>(static_cast<std::size_t>(robots)),
              .readings = std::filesystem::exists(whole)
                              ? test::PartedLog(whole, robots)
                              : test::PartedDrive(Load(whole, seed, duration), robots)};
  for (std::size_t robot = 1; robot < drive.robots.size(); ++robot) {
    drive.robots[robot].tells_start = false;
  }
  return drive;
}

Drive DriveOf(const std::string& name, int seed, const std::string& duration) {
  const std::size_t at = name.find('@');
  if (at == std::string::npos) return DriveOf(Load(FileOf(name), seed, duration));
  return PartsOf(name.substr(0, at), std::stoi(name.substr(at + 1)), seed, duration);
}

bool WasNear(const Fate& other, const Eigen::Vector2d& p_m) {
  return std::ranges::any_of(other.path_world_m, [&](const Eigen::Vector2d& there_m) {
    return (there_m - p_m).norm() < kInCommon_m;
  });
}

/// A team's service that is given what robots measure.
class Trial {
 public:
  /// @param are_told_rightly all of them, else as they are told in the scenario.
  Trial(std::vector<sim::RobotOptions> robots, bool are_told_rightly)
      : robots_(std::move(robots)),
        are_told_rightly_(are_told_rightly),
        service_(Options(), SinkList<TeamSink>(answers_)) {
    service_.Start();
  }

  void Take(const sim::Reading& reading, std::size_t step) {
    const std::string robot = NameOf(reading.robot);
    if (!fates_.contains(reading.robot)) TellStart(reading);
    Fate& fate = fates_[reading.robot];
    service_.robots().TakeOdometry(robot, reading.scan.stamp, reading.T_odom_robot);
    service_.robots().TakeScan(robot, reading.scan);
    service_.WaitUntilIdle();
    Follow(reading, fate);
    Judge(reading, step, fate);
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

  void TellStart(const sim::Reading& reading) {
    const sim::RobotOptions& robot = robots_[reading.robot];
    if (!are_told_rightly_ && !robot.tells_start) return;
    const Pose2 told =
        are_told_rightly_ ? reading.T_world_robot : sim::ToldStart(robot, reading.T_world_robot);
    service_.robots().PlaceAt(NameOf(reading.robot), UncertainPose2::WithSigmas(told, 1e-3, 1e-3));
  }

  /// Where it drives where others have been that are in another component.
  void Follow(const sim::Reading& reading, Fate& fate) {
    const Eigen::Vector2d p_m = reading.T_world_robot.translation_m();
    const double way_m = fate.path_world_m.empty() ? 0.0 : (p_m - fate.path_world_m.back()).norm();
    fate.path_world_m.push_back(p_m);
    fate.way_m += way_m;
    const RobotAnswer& answer = answers_.Of(NameOf(reading.robot));
    component_[reading.robot] = answer.component;
    T_component_world_[reading.robot] =
        answer.step.map_robot.T_a_b * reading.T_world_robot.Inverse();
    for (auto& [other, of_other] : fates_) {
      if (component_[other] == component_[reading.robot] || !WasNear(of_other, p_m)) continue;
      fate.in_common_m[other] += way_m;
      of_other.in_common_m[reading.robot] += way_m;
    }
  }

  void Judge(const sim::Reading& reading, std::size_t step, Fate& fate) {
    const bool is_apart = !component_[reading.robot].empty();
    const bool was_apart = std::exchange(fate.is_apart, is_apart);
    if (is_apart) return JudgeApart(reading, fate, !was_apart && !fate.steps.empty());
    const RobotAnswer& answer = answers_.Of(NameOf(reading.robot));
    const Pose2 error = reading.T_world_robot.Inverse() * answer.step.map_robot.T_a_b;
    const double error_m = error.translation_m().norm();
    if (was_apart) {
      fate.found_off_m = std::max(fate.found_off_m, error_m);
      fate.beyond_drift_m = std::max(fate.beyond_drift_m, error_m - fate.drifted_m);
      fate.found_in_common_m = MostInCommon(fate);
    }
    fate.steps.push_back(step);
    fate.errors_m.push_back(error_m);
    fate.answers.push_back({.stamp = reading.scan.stamp,
                            .T_ref_robot = reading.T_world_robot,
                            .T_map_robot = answer.step.map_robot.T_a_b});
  }

  void JudgeApart(const sim::Reading& reading, Fate& fate, bool is_lost) {
    fate.was_apart = true;
    FollowDrift(reading, fate);
    if (is_lost) {
      ++fate.times_lost;
      fate.in_common_m.clear();
      for (auto& [other, of_other] : fates_) of_other.in_common_m.erase(reading.robot);
    }
    fate.found_in_common_m = 0.0;
    for (const auto& [other, with_m] : fate.in_common_m) {
      fate.found_in_common_m = std::max(fate.found_in_common_m, with_m);
    }
    for (const auto& [other, T_component_world] : T_component_world_) {
      if (component_[other] != component_[reading.robot]) continue;
      const Pose2 T_map_robot = T_component_world * reading.T_world_robot;
      const Eigen::Vector2d off_m =
          T_map_robot.translation_m() -
          answers_.Of(NameOf(reading.robot)).step.map_robot.T_a_b.translation_m();
      if (off_m.norm() > kWrong_m) fate.is_beside_others_wrongly = true;
    }
  }

  void FollowDrift(const sim::Reading& reading, Fate& fate) const {
    const Pose2& T_component_world = T_component_world_.at(reading.robot);
    if (std::exchange(fate.apart_in, component_.at(reading.robot)) != fate.apart_in) {
      fate.T_apart_world = T_component_world;
    }
    const Eigen::Vector2d p_m = reading.T_world_robot.translation_m();
    fate.drifted_m = (T_component_world * p_m - fate.T_apart_world * p_m).norm();
  }

  double MostInCommon(const Fate& fate) const {
    double most_m = 0.0;
    for (const auto& [other, way_m] : fate.in_common_m) {
      if (component_.at(other).empty()) most_m = std::max(most_m, way_m);
    }
    return most_m;
  }

  const std::vector<sim::RobotOptions> robots_;
  const bool are_told_rightly_;
  LastAnswers answers_;
  TeamService service_;
  std::map<std::size_t, Fate> fates_;
  std::map<std::size_t, std::string> component_;
  std::map<std::size_t, Pose2> T_component_world_;  // As the robot's last answer has it.
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

/// How many answers in the team's map were far off.
int CountAstray(const Fate& fate) {
  return static_cast<int>(
      std::ranges::count_if(fate.errors_m, [](double error_m) { return error_m > kWrong_m; }));
}

using Fates = std::map<std::size_t, Fate>;

/// Absolute trajectory error of a team in its map, wherever that lies in the world, of what both
/// trials have answered in it.
double TeamError(const Fates& fates, const Fates& others) {
  std::vector<PosePair> pairs;
  for (const auto& [robot, fate] : fates) {
    const std::vector<std::size_t>& steps = others.at(robot).steps;
    for (std::size_t i = 0; i < fate.steps.size(); ++i) {
      if (std::ranges::binary_search(steps, fate.steps[i])) pairs.push_back(fate.answers[i]);
    }
  }
  return AbsoluteTrajectoryError(pairs, AlignUmeyama(pairs)).rmse;
}

struct Sum {
  int robots = 0;
  int found = 0;
  int in_time = 0;
  int with_enough_in_common = 0;
  int wrong = 0;
  std::vector<double> times_told;  // ATE of the team over that of one that was told.
};

void Print(int seed, std::size_t robot, const Fate& fate, const Fate& told, Sum& sum) {
  constexpr double kInTime_m = 10.0;
  const bool is_found = fate.was_apart && !fate.is_apart;
  const bool is_wrong = fate.beyond_drift_m > kWrong_m || fate.is_beside_others_wrongly;
  const bool had_time = is_found || fate.found_in_common_m > kInTime_m;
  const bool is_astray = !fate.errors_m.empty() && fate.errors_m.back() > kWrong_m;
  ++sum.robots;
  sum.found += is_found ? 1 : 0;
  sum.with_enough_in_common += had_time ? 1 : 0;
  sum.in_time += is_found && fate.found_in_common_m <= kInTime_m ? 1 : 0;
  sum.wrong += is_wrong ? 1 : 0;
  std::printf(
      "%d %s: drove %.1f m, lost %d times, %.1f m in common, %s, %.3f m off, "
      "%.3f m beyond its drift; %d answers "
      "astray; rms %.4f m, told %.4f m%s\n",
      seed,
      NameOf(robot).c_str(),
      fate.way_m,
      fate.times_lost,
      fate.found_in_common_m,
      is_found        ? "found"
      : fate.is_apart ? "apart"
      : is_astray     ? "not noticed"
                      : "put right",
      fate.found_off_m,
      fate.beyond_drift_m,
      CountAstray(fate),
      Rms(fate.errors_m),
      RmsAt(told, fate.steps),
      is_wrong ? " WRONG" : "");
  std::fflush(stdout);
}

void Evaluate(const std::string& name, int seed, const std::string& duration, Sum& sum) {
  const Drive drive = DriveOf(name, seed, duration);
  Trial trial(drive.robots, false);
  Trial told(drive.robots, true);
  for (std::size_t step = 0; step < drive.readings.size(); ++step) {
    trial.Take(drive.readings[step], step);
    told.Take(drive.readings[step], step);
  }
  for (const auto& [robot, fate] : trial.fates()) {
    const bool had_trouble = fate.was_apart || CountAstray(fate) > 0;
    if (had_trouble) Print(seed, robot, fate, told.fates().at(robot), sum);
  }
  const double error_m = TeamError(trial.fates(), told.fates());
  const double told_m = TeamError(told.fates(), trial.fates());
  sum.times_told.push_back(error_m / told_m);
  std::printf("%d team: ATE %.4f m, told %.4f m, %.2f times\n",
              seed,
              error_m,
              told_m,
              sum.times_told.back());
  for (const auto& [robot, fate] : told.fates()) {
    if (!fate.was_apart) continue;
    std::printf(
        "%d %s: lost %d times where all are told\n", seed, NameOf(robot).c_str(), fate.times_lost);
  }
}

}  // namespace
}  // namespace qwsm::team

int main(int argc, char** argv) {
  constexpr const char* kUsage = "usage: evaluate_team SCENARIO FIRST_SEED LAST_SEED DURATION_S\n";
  if (argc != 5) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  qwsm::team::Sum sum;
  try {
    for (int seed = std::stoi(argv[2]); seed <= std::stoi(argv[3]); ++seed) {
      qwsm::team::Evaluate(argv[1], seed, argv[4], sum);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "evaluate_team: %s\n%s", error.what(), kUsage);
    return 2;
  }
  std::printf("%s: %d robots, %d found, %d wrong; %d of %d within 10 m in common\n",
              argv[1],
              sum.robots,
              sum.found,
              sum.wrong,
              sum.in_time,
              sum.with_enough_in_common);
  std::ranges::sort(sum.times_told);
  const auto as_told = std::ranges::upper_bound(sum.times_told, 1.2) - sum.times_told.begin();
  std::printf("ATE over that of teams that were told: %.2f in the median, within 1.2 in %d of %d\n",
              sum.times_told.empty() ? 0.0 : sum.times_told[sum.times_told.size() / 2],
              static_cast<int>(as_told),
              static_cast<int>(sum.times_told.size()));
  return sum.wrong == 0 ? 0 : 1;
}
