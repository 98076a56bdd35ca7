// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// epoch_latency [SCANS [ROUNDS]]: what robots wait for while the whole map is put elsewhere.
// Four robots are answered ten times a second, in real time, in a map of SCANS relevant scans (2000)
// of another service. First that other service corrects all of the map, ROUNDS times (5). Then it
// has drawn the map with a drift, and the service that answers finds the loops and corrects the map
// itself, in ROUNDS runs; as many runs over the same scans leave the map as it is. Prints the time
// from a scan to its pose while a correction is computed, taken in, and until a second after, and
// else.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <mutex>
#include <optional>
#include <span>
#include <string>
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
constexpr double kLongestLook_s = 60.0;
constexpr double kDrift_rad_s = 0.001;

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

/// Keeps when poses were told and how long after their scans, but of each robot's first, which is
/// looked for.
class TimingSink final : public team::TeamSink {
 public:
  struct Answer {
    Clock::time_point told;
    double latency_ms = 0.0;
  };
  void TakeAnswer(const team::RobotAnswer& answer) override {
    if (answer.scans == 1) return;
    const std::lock_guard lock(mutex_);
    answers_.push_back({Clock::now(), Milliseconds(answer.latency).count()});
  }
  void TakeEpoch(const team::TeamEpoch&) override {
    const std::lock_guard lock(mutex_);
    corrected_ = Clock::now();
  }
  std::vector<Answer> answers() const {
    const std::lock_guard lock(mutex_);
    return answers_;
  }
  /// When the map was corrected last.
  std::optional<Clock::time_point> corrected() const {
    const std::lock_guard lock(mutex_);
    return corrected_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Answer> answers_;
  std::optional<Clock::time_point> corrected_;
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

team::TeamServiceOptions OptionsFor(std::span<const sim::Reading> readings) {
  team::TeamServiceOptions options;
  options.team.map_period_s = 0.0;
  for (std::size_t i = 0; i < kRobots; ++i) {
    const Pose2& start = readings[i].T_world_robot;
    options.team.robots.push_back(
        {.name = NameOf(i), .x_m = start.x_m, .y_m = start.y_m, .heading_rad = start.theta_rad});
  }
  return options;
}

/// What another service has mapped. @param pose_of where it has put the scan of a reading.
template <class PoseOf>
void TakeMapOfAnother(team::TeamService& service, std::size_t scans, PoseOf pose_of) {
  std::size_t sequence = 0;
  for (sim::Reading& reading : Drive(static_cast<double>(scans) / kRobots / kRate_hz, 2)) {
    const std::string robot = "scout" + std::to_string(reading.robot + 1);
    service.TakeIn({{.key = {.service = "elsewhere", .robot = robot, .sequence = ++sequence},
                     .scan = reading.scan,
                     .map_robot = pose_of(reading)}});
  }
}

/// Gives the readings when they are due. @param goes_on whether to go on before each of them.
/// @return how many were given.
template <class GoesOn>
std::size_t DriveInRealTime(team::TeamService& service,
                            std::span<const sim::Reading> readings,
                            GoesOn goes_on) {
  const auto begin = Clock::now();
  std::size_t given = 0;
  for (const sim::Reading& reading : readings) {
    if (!goes_on()) break;
    std::this_thread::sleep_until(begin +
                                  std::chrono::duration_cast<Clock::duration>(
                                      reading.scan.stamp - readings.front().scan.stamp) +
                                  reading.robot * 25ms);
    service.robots().TakeOdometry(NameOf(reading.robot), reading.scan.stamp, reading.T_odom_robot);
    service.robots().TakeScan(NameOf(reading.robot), reading.scan);
    ++given;
  }
  service.WaitUntilIdle();
  return given;
}

/// Another service corrects the map.
void MeasureOfAnother(std::size_t scans, int rounds) {
  const std::vector<sim::Reading> readings = Drive(kSecondsBetween * (rounds + 1), 1);
  TimingSink sink;
  team::TeamService service(OptionsFor(readings), sink);
  service.Start();
  TakeMapOfAnother(service, scans, [](const sim::Reading& reading) {
    return UncertainPose2::WithSigmas(reading.T_world_robot, 0.01, 0.001);
  });
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
  DriveInRealTime(service, readings, [] { return true; });
  corrector.join();
  std::vector<double> during, otherwise;
  for (const TimingSink::Answer& answer : sink.answers()) {
    (IsBeside(corrections, answer.told) ? during : otherwise).push_back(answer.latency_ms);
  }
  Print("corrected", std::move(during));
  Print("else", std::move(otherwise));
}

/// Another service has drawn the map with a drift.
/// @param corrects whether the service finds its loops: then the readings are cut to those until a
/// second after the map was corrected.
std::vector<double> LatenciesInBentMap(std::size_t scans,
                                       bool corrects,
                                       std::span<const sim::Reading>& readings) {
  team::TeamServiceOptions options = OptionsFor(readings);
  options.corrects = corrects;
  TimingSink sink;
  team::TeamService service(options, sink);
  service.Start();
  TakeMapOfAnother(service, scans, [](const sim::Reading& reading) {
    const Pose2 drift{.theta_rad = kDrift_rad_s * Seconds(reading.scan.stamp)};
    return UncertainPose2::WithSigmas(drift * reading.T_world_robot, 0.1, 0.01);
  });
  const Clock::time_point begun = Clock::now();
  readings = readings.first(DriveInRealTime(service, readings, [&] {
    const std::optional<Clock::time_point> corrected = sink.corrected();
    return !corrected || Clock::now() < *corrected + 1s;
  }));
  if (const std::optional<Clock::time_point> corrected = sink.corrected()) {
    std::printf("corrected %6.2f s after all scans had come\n",
                Milliseconds(*corrected - begun).count() / 1000.0);
  }
  std::vector<double> latencies_ms;
  for (const TimingSink::Answer& answer : sink.answers()) latencies_ms.push_back(answer.latency_ms);
  return latencies_ms;
}

/// The service corrects the map itself, or leaves it.
void MeasureOwn(std::size_t scans, int rounds) {
  const std::vector<sim::Reading> all = Drive(kLongestLook_s, 1);
  std::vector<double> corrected, left;
  for (int round = 0; round < rounds; ++round) {
    std::span<const sim::Reading> readings = all;
    std::ranges::copy(LatenciesInBentMap(scans, true, readings), std::back_inserter(corrected));
    std::ranges::copy(LatenciesInBentMap(scans, false, readings), std::back_inserter(left));
  }
  Print("corrected", std::move(corrected));
  Print("left as it is", std::move(left));
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t scans = argc > 1 ? std::stoul(argv[1]) : 2000;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  std::printf("Another service corrects the map:\n");
  MeasureOfAnother(scans, rounds);
  std::printf("The service corrects the map itself:\n");
  MeasureOwn(scans, rounds);
  return EXIT_SUCCESS;
}
