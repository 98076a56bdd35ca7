// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/robot_session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "qwsm/mapping/place_finder.hpp"

namespace qwsm::team {
namespace {

using std::chrono::steady_clock;

// Odometry this far behind the scans is not worth waiting for.
constexpr std::chrono::nanoseconds kOdometryGone = std::chrono::seconds(1);
// A robot without a place is looked for in the map not more often than this.
constexpr std::chrono::nanoseconds kSearchPeriod = std::chrono::seconds(2);
// How far a robot may have been pushed while nobody looked, and how exact a found place is.
constexpr double kPushed_m = 0.3;
constexpr double kPushed_rad = 0.1;
// What odometry may jump by in no time.
constexpr double kJump_m = 0.5;
constexpr double kJump_rad = 0.5;

UncertainPose2 Loosened(UncertainPose2 pose) {
  pose.covariance.diagonal() += Eigen::Vector3d(kPushed_m, kPushed_m, kPushed_rad).cwiseAbs2();
  return pose;
}

LatencySummary Summarize(const LatencyHistogram& histogram) {
  return {.median = histogram.Quantile(0.5),
          .p99 = histogram.Quantile(0.99),
          .longest = histogram.longest()};
}

}  // namespace

RobotSession::RobotSession(std::string name,
                           const SessionOptions& options,
                           const MapperOptions& mapper,
                           SessionContext context)
    : name_(std::move(name)),
      options_(options),
      context_(std::move(context)),
      queue_(static_cast<std::size_t>(options.queue_scans)),
      tracker_(mapper),
      sequence_(context_.map.LastSequence(context_.service, name_)) {}

void RobotSession::SetStart(const UncertainPose2& map_robot) {
  const std::lock_guard lock(mutex_);
  start_ = map_robot;
}

void RobotSession::Join() {
  {
    const std::lock_guard lock(mutex_);
    if (state_ != RobotState::kExpected && state_ != RobotState::kLost) return;
    is_interrupted_ = true;
    state_ =
        std::exchange(state_, RobotState::kUnplaced) == RobotState::kLost && counts_.answered > 0
            ? RobotState::kTracked
            : RobotState::kUnplaced;
  }
  Tell(false, "joined");
}

void RobotSession::Lose() {
  {
    const std::lock_guard lock(mutex_);
    if (state_ == RobotState::kLost || state_ == RobotState::kExpected) return;
    state_ = RobotState::kLost;
  }
  Tell(true, "is lost: nobody publishes its scans any more");
}

bool RobotSession::TakeScan(LaserScan scan) {
  const std::string_view objection = ObjectionTo(scan);
  Join();
  const std::lock_guard lock(mutex_);
  ++counts_.scans;
  if (!objection.empty()) {
    ++counts_.malformed;
    return false;
  }
  switch (guard_.Judge(scan.stamp)) {
    case StampVerdict::kDuplicate:
      ++counts_.duplicates;
      return false;
    case StampVerdict::kLate:
      ++counts_.late;
      return false;
    case StampVerdict::kClockReset:
      ++counts_.clock_resets;
      is_interrupted_ = true;
      break;
    case StampVerdict::kInOrder:
      break;
  }
  queue_.Push({.scan = std::move(scan), .arrived = steady_clock::now()});
  counts_.dropped = queue_.dropped();
  return true;
}

void RobotSession::TakeOdometry(Timestamp stamp, const Pose2& T_odom_robot) {
  const std::lock_guard lock(mutex_);
  ++counts_.odometry_readings;
  expects_odometry_ = true;
  if (!odometry_.Add(stamp, T_odom_robot)) ++counts_.odometry_refused;
}

void RobotSession::ExpectOdometry(bool expected) {
  const std::lock_guard lock(mutex_);
  expects_odometry_ = expected;
}

void RobotSession::PlaceAt(const UncertainPose2& map_robot) {
  const std::string_view objection = ObjectionTo(map_robot);
  if (!objection.empty()) return Tell(true, objection);
  {
    const std::lock_guard lock(mutex_);
    told_ = map_robot;
  }
  Tell(false, "was told where it is");
}

RobotStatus RobotSession::Status() const {
  const std::lock_guard lock(mutex_);
  return {.name = name_,
          .state = state_,
          .map_robot = map_robot_,
          .stamp = stamp_,
          .waiting = queue_.size(),
          .counts = counts_,
          .matching = Summarize(matching_),
          .latency = Summarize(latency_)};
}

std::optional<Lane::Time> RobotSession::ReadyAt() const {
  const std::lock_guard lock(mutex_);
  if (queue_.empty()) return std::nullopt;
  const Arrival& next = queue_.front();
  if (!AwaitsOdometry(next.scan)) return next.arrived;
  return next.arrived + std::chrono::duration_cast<steady_clock::duration>(
                            std::chrono::duration<double>(options_.odometry_wait_s));
}

bool RobotSession::AwaitsOdometry(const LaserScan& scan) const {
  if (!expects_odometry_ || odometry_.Covers(scan.stamp)) return false;
  return odometry_.empty() || odometry_.Covers(scan.stamp - kOdometryGone);
}

void RobotSession::RunOne() {
  std::optional<Work> work = Take();
  if (!work) return;
  const std::vector<ScanPoint> points = ToPoints(work->arrival.scan);
  Answer(*work, points);
}

std::optional<RobotSession::Work> RobotSession::Take() {
  const std::lock_guard lock(mutex_);
  if (queue_.empty()) return std::nullopt;
  Work work{
      .arrival = queue_.Pop(), .T_odom_robot = {}, .told = std::exchange(told_, std::nullopt)};
  work.T_odom_robot = odometry_.At(work.arrival.scan.stamp);
  work.is_interrupted = std::exchange(is_interrupted_, false);
  return work;
}

void RobotSession::Answer(Work& work, std::span<const ScanPoint> points) {
  const auto begun = steady_clock::now();
  Observation observation{.scan = std::move(work.arrival.scan), .T_odom_robot = work.T_odom_robot};
  MappingStep step;
  {
    const TeamMap::State::View map = context_.map.Read();
    work.arrival.scan.stamp = observation.scan.stamp;
    is_placed_ = Place(*map, work, points);
    if (!is_placed_) {
      const std::lock_guard lock(mutex_);
      ++counts_.unplaced;
      return;
    }
    WatchOdometry(work);
    step = tracker_.Track(*map, observation, points);
  }
  const auto answered = steady_clock::now();
  Count(work, step, answered - begun);
  const RobotStatus status = Status();
  const RobotAnswer answer{.robot = name_,
                           .step = step,
                           .T_odom_robot = work.T_odom_robot,
                           .matching = answered - begun,
                           .latency = answered - work.arrival.arrived,
                           .scans = status.counts.scans,
                           .dropped = status.counts.dropped};
  context_.sink.TakeAnswer(answer);
  if (step.relevant) {
    context_.extend({.key = {.service = context_.service, .robot = name_, .sequence = ++sequence_},
                     .scan = std::move(observation.scan),
                     .map_robot = step.map_robot,
                     .T_odom_robot = work.T_odom_robot},
                    points);
  }
  context_.report(answer);
}

bool RobotSession::Place(const ScanMap& map, const Work& work, std::span<const ScanPoint> points) {
  if (work.told) {
    tracker_.PlaceAt(*work.told);
    return true;
  }
  if (is_placed_) return true;
  if (const std::optional<TeamScan> last = context_.map.LastOf(name_)) {
    tracker_.PlaceAt(Loosened(last->map_robot), last->T_odom_robot);
    tracker_.DoubtOdometry();
    return true;
  }
  if (start_) {
    tracker_.PlaceAt(*start_);
    return true;
  }
  if (!map.empty()) return FindPlaceIn(map, work.arrival.scan.stamp, points);
  return context_.map.Begin();
}

bool RobotSession::FindPlaceIn(const ScanMap& map,
                               Timestamp stamp,
                               std::span<const ScanPoint> points) {
  if (looked_for_place_ && stamp - *looked_for_place_ < kSearchPeriod) return false;
  looked_for_place_ = stamp;
  const std::optional<FoundPlace> found = FindPlace(map, points);
  if (!found || found->rival) {
    Tell(true,
         found ? "fits several places in the map: an initial pose would tell which"
               : "fits nowhere in the map: an initial pose would tell where it is");
    return false;
  }
  tracker_.PlaceAt(Loosened({.T_a_b = found->best.T_map_robot}));
  Tell(false, "was found in the map");
  return true;
}

// Odometry that moves faster than any robot has begun anew; after an interruption it may have.
void RobotSession::WatchOdometry(const Work& work) {
  const Timestamp stamp = work.arrival.scan.stamp;
  if (work.T_odom_robot && T_odom_last_) {
    const Pose2 moved = T_odom_last_->Inverse() * *work.T_odom_robot;
    const double elapsed_s =
        std::max(0.0, std::chrono::duration<double>(stamp - last_stamp_).count());
    if (moved.translation_m().norm() > kJump_m + options_.max_speed_mps * elapsed_s ||
        std::abs(moved.theta_rad) > kJump_rad + options_.max_turn_rate_radps * elapsed_s) {
      tracker_.DoubtOdometry();
      const std::lock_guard lock(mutex_);
      ++counts_.odometry_jumps;
    } else if (work.is_interrupted) {
      tracker_.DoubtOdometry();
    }
  }
  T_odom_last_ = work.T_odom_robot;
  last_stamp_ = stamp;
}

void RobotSession::Count(const Work& work,
                         const MappingStep& step,
                         std::chrono::nanoseconds matching) {
  const std::lock_guard lock(mutex_);
  if (state_ == RobotState::kUnplaced) state_ = RobotState::kTracked;
  ++counts_.answered;
  if (step.status == StepStatus::kDeadReckoned) ++counts_.dead_reckoned;
  if (step.relevant) ++counts_.relevant;
  if (!work.T_odom_robot) ++counts_.without_odometry;
  matching_.Add(matching);
  latency_.Add(steady_clock::now() - work.arrival.arrived);
  map_robot_ = step.map_robot;
  stamp_ = step.stamp;
}

void RobotSession::Tell(bool is_warning, std::string_view text) const {
  context_.sink.TakeEvent({.robot = name_, .is_warning = is_warning, .text = text});
}

}  // namespace qwsm::team
