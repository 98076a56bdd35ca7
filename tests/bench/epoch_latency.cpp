// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// epoch_latency [SCANS [ROUNDS]]: what robots wait for while the whole map is put elsewhere.
// A map of SCANS relevant scans (2000) of another service; four robots are answered in it ten times
// a second, in real time, and ROUNDS times (5) that other service corrects all of the map. Prints
// the time from a scan to its pose, from each correction until a second after it has taken effect,
// and else.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <vector>

#include "service/team/service/team_service.hpp"
#include "sim/simulation.hpp"
#include "tests/support/moved_map.hpp"
#include "tests/support/process_state.hpp"

namespace {

using namespace qwsm;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr int kRobots = 4;
constexpr double kRate_hz = 10.0;
constexpr int kSecondsBetween = 4;

std::string NameOf(std::size_t robot) { return "robot" + std::to_string(robot + 1); }

std::vector<sim::Reading> Drive(double duration_s, int seed) {
  sim::ScenarioOptions scenario;
  scenario.duration_s = duration_s;
  scenario.seed = seed;
  scenario.layout.kind = sim::LayoutKind::kOffice;
  scenario.layout.office.persons = 0;
  scenario.layout.office.routes = kRobots;
  for (std::size_t i = 0; i < kRobots; ++i) {
    sim::RobotOptions robot;
    robot.name = NameOf(i);
    robot.laser.beams = 361;
    robot.laser.rate_hz = kRate_hz;
    robot.laser.useful_range_m = 30.0;
    scenario.robots.push_back(robot);
  }
  std::vector<sim::Reading> readings;
  sim::Simulation simulation(scenario);
  while (auto reading = simulation.Next()) readings.push_back(std::move(*reading));
  return readings;
}

/// Keeps when poses were told and how long after their scans.
class TimingSink final : public team::TeamSink {
 public:
  struct Answer {
    Clock::time_point told;
    double latency_ms = 0.0;
  };
  void TakeAnswer(const team::RobotAnswer& answer) override {
    const std::lock_guard lock(mutex_);
    answers_.push_back({Clock::now(), Milliseconds(answer.latency).count()});
  }
  std::vector<Answer> answers() const {
    const std::lock_guard lock(mutex_);
    return answers_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Answer> answers_;
};

void Print(const char* when, std::vector<double> ms) {
  std::ranges::sort(ms);
  if (ms.empty()) return;
  const auto at = [&](double share) {
    return ms[static_cast<std::size_t>(share * static_cast<double>(ms.size() - 1))];
  };
  std::printf("%-18s %6zu answers  median %7.3f ms  p99 %8.3f  longest %8.3f\n",
              when,
              ms.size(),
              at(0.5),
              at(0.99),
              ms.back());
}

/// When a correction was taken in.
struct Correction {
  Clock::time_point begun;
  Clock::time_point ended;
};

bool IsBeside(const std::vector<Correction>& corrections, Clock::time_point told) {
  return std::ranges::any_of(corrections, [&](const Correction& correction) {
    return told >= correction.begun && told < correction.ended + 1s;
  });
}

int Measure(std::size_t scans, int rounds) {
  const std::vector<sim::Reading> readings = Drive(kSecondsBetween * (rounds + 1), 1);
  team::TeamServiceOptions options;
  options.team.map_period_s = 0.0;
  for (std::size_t i = 0; i < kRobots; ++i) {
    const Pose2& start = readings[i].T_world_robot;
    options.team.robots.push_back(
        {.name = NameOf(i), .x_m = start.x_m, .y_m = start.y_m, .heading_rad = start.theta_rad});
  }
  TimingSink sink;
  team::TeamService service(options, sink);
  service.Start();
  std::size_t sequence = 0;
  for (sim::Reading& reading : Drive(static_cast<double>(scans) / kRobots / kRate_hz, 2)) {
    const std::string robot = "scout" + std::to_string(reading.robot + 1);
    service.TakeIn({{.key = {.service = "elsewhere", .robot = robot, .sequence = ++sequence},
                     .scan = reading.scan,
                     .map_robot = UncertainPose2::WithSigmas(reading.T_world_robot, 0.01, 0.001)}});
  }
  std::vector<Correction> corrections;
  std::jthread corrector([&] {
    for (int round = 1; round <= rounds; ++round) {
      std::this_thread::sleep_for(std::chrono::seconds(kSecondsBetween));
      const Pose2 there_and_back{.x_m = round % 2 == 0 ? 0.003 : -0.003};
      const team::TeamEpoch epoch =
          test::Moved(service.MapOf("robot1")->Scans(),
                      there_and_back,
                      {.number = static_cast<std::uint64_t>(round) * 10, .service = "elsewhere"});
      Correction& correction = corrections.emplace_back();
      correction.begun = Clock::now();
      service.TakeIn(epoch);
      service.WaitUntilIdle();
      correction.ended = Clock::now();
      const double took_ms = Milliseconds(correction.ended - correction.begun).count();
      std::printf("taking it in took %7.1f ms; %zu scans, %.1f MB in use\n",
                  took_ms,
                  epoch.scans.size(),
                  test::ResidentKilobytes(getpid()) / 1024.0);
    }
  });
  const auto begin = Clock::now();
  for (const sim::Reading& reading : readings) {
    std::this_thread::sleep_until(begin +
                                  std::chrono::duration_cast<Clock::duration>(
                                      reading.scan.stamp - readings.front().scan.stamp) +
                                  reading.robot * 25ms);
    service.robots().TakeOdometry(NameOf(reading.robot), reading.scan.stamp, reading.T_odom_robot);
    service.robots().TakeScan(NameOf(reading.robot), reading.scan);
  }
  corrector.join();
  service.WaitUntilIdle();
  std::vector<double> during, otherwise;
  for (const TimingSink::Answer& answer : sink.answers()) {
    (IsBeside(corrections, answer.told) ? during : otherwise).push_back(answer.latency_ms);
  }
  Print("corrected", std::move(during));
  Print("else", std::move(otherwise));
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  return Measure(argc > 1 ? std::stoul(argv[1]) : 2000, argc > 2 ? std::atoi(argv[2]) : 5);
}
