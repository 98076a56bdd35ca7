// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/team_traffic.hpp"

#include <algorithm>
#include <thread>
#include <utility>

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPatience = 10s;
constexpr auto kSilence = 2s;

sim::ScenarioOptions Office(const TeamOptions& options) {
  sim::ScenarioOptions scenario;
  scenario.duration_s = options.duration_s;
  scenario.layout.kind = sim::LayoutKind::kOffice;
  scenario.layout.office.rooms_per_side = std::max(4, (options.robots + 1) / 2);
  scenario.layout.office.persons = 0;
  scenario.layout.office.routes = options.robots;
  for (int i = 0; i < options.robots; ++i) {
    sim::RobotOptions robot;
    robot.name = "robot" + std::to_string(i + 1);
    robot.laser.beams = options.beams;
    robot.laser.rate_hz = options.rate_hz;
    robot.laser.useful_range_m = 30.0;
    scenario.robots.push_back(robot);
  }
  return scenario;
}

}  // namespace

struct TeamTraffic::Robot {
  Robot(const dds::Participant& participant, const std::string& name)
      : publisher(participant, dds::RobotNames(name), dds::OdometryUse::kPublished) {}

  dds::RobotPublisher publisher;
  Timestamp last_answered{-1};
  std::uint64_t counted = 0;
  std::uint64_t dropped = 0;
};

TeamTraffic::TeamTraffic(const TeamOptions& options) : period_s_(1.0 / options.rate_hz) {
  sim::Simulation simulation(Office(options));
  while (std::optional<sim::Reading> reading = simulation.Next()) {
    readings_.push_back(std::move(*reading));
  }
}

TeamTraffic::~TeamTraffic() = default;

bool TeamTraffic::Join(const dds::NetworkOptions& network) {
  participant_ = std::make_unique<dds::Participant>(network);
  std::vector<std::string> names;
  for (const sim::Reading& reading : readings_) {
    if (reading.robot < names.size()) break;  // The second scan of the first robot.
    names.push_back("robot" + std::to_string(reading.robot + 1));
  }
  reports_ = std::make_unique<dds::MatchReportReader>(*participant_, names);
  const auto until = Clock::now() + kPatience;
  for (std::size_t i = 0; i < names.size(); ++i) {
    dds::RobotPublisher& publisher =
        robots_.emplace_back(std::make_unique<Robot>(*participant_, names[i]))->publisher;
    if (!publisher.WaitForListener({}, until - Clock::now())) return false;
    while (!publisher.has_pose_listener() || !reports_->has_writer()) {
      if (Clock::now() > until) return false;
      std::this_thread::sleep_for(5ms);
    }
    UncertainPose2 start{.T_a_b = readings_[i].T_world_robot};
    start.covariance.diagonal() = Eigen::Vector3d(1e-3, 1e-3, 1e-4);
    publisher.TellPose(readings_[i].scan.stamp, start);
  }
  std::this_thread::sleep_for(200ms);  // What was told is best effort; nobody says it arrived.
  return true;
}

TrafficResult TeamTraffic::Run(std::size_t scans, double speed) {
  TrafficResult result;
  const auto begin = Clock::now();
  const Timestamp first = readings_[next_].scan.stamp;
  for (const std::size_t end = next_ + scans; next_ < end; ++next_) {
    const sim::Reading& reading = readings_[next_];
    // Robots do not take their scans all in one moment.
    const double offset_s =
        period_s_ * static_cast<double>(reading.robot) / static_cast<double>(robots_.size());
    const std::chrono::duration<double> due_after =
        (reading.scan.stamp - first + std::chrono::duration<double>(offset_s)) / speed;
    const auto due = begin + std::chrono::duration_cast<Clock::duration>(due_after);
    Hear(0ns, result);
    std::this_thread::sleep_until(due);
    result.latest = std::max<std::chrono::nanoseconds>(result.latest, Clock::now() - due);
    robots_[reading.robot]->publisher.Publish(
        {.scan = reading.scan, .T_odom_robot = reading.T_odom_robot});
    ++result.sent;
  }
  // Who is busy answers late; who has nothing more to answer is silent.
  auto heard = Clock::now();
  while (Clock::now() < heard + kSilence) {
    if (Hear(100ms, result)) heard = Clock::now();
  }
  for (const auto& robot : robots_) {
    result.counted += robot->counted;
    result.dropped += robot->dropped;
  }
  std::ranges::sort(result.matching);
  std::ranges::sort(result.latency);
  return result;
}

bool TeamTraffic::Hear(std::chrono::nanoseconds timeout, TrafficResult& result) {
  const std::vector<dds::MatchReport> reports = reports_->Take(timeout);
  for (const dds::MatchReport& report : reports) {
    Robot& robot = *robots_[std::stoul(report.robot.substr(5)) - 1];
    if (report.stamp <= robot.last_answered) ++result.out_of_order;
    robot.last_answered = report.stamp;
    robot.counted = report.scans;
    robot.dropped = report.dropped;
    ++result.answered;
    result.answers.push_back({.heard = std::chrono::system_clock::now(),
                              .matching = report.duration,
                              .latency = report.latency});
    result.matching.push_back(report.duration);
    result.latency.push_back(report.latency);
  }
  return !reports.empty();
}

std::chrono::nanoseconds Quantile(const std::vector<std::chrono::nanoseconds>& sorted,
                                  double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace qwsm::test
