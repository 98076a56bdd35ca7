// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/session/session_intake.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "qwsm/sensor/scan_limits.hpp"
#include "service/team/scans/thinning.hpp"
#include "service/team/session/deskewing.hpp"

namespace qwsm::team {
namespace {

using std::chrono::steady_clock;

// Odometry this far behind the scans is not worth waiting for.
constexpr std::chrono::nanoseconds kOdometryGone = std::chrono::seconds(1);
// What odometry may jump by in no time.
constexpr double kJump_m = 0.5;
constexpr double kJump_rad = 0.5;

double LengthM(const Pose2& motion) { return motion.translation_m().norm(); }
double LengthM(const slam6d::Pose3& motion) { return motion.translation_m.norm(); }
constexpr std::size_t kMostSensors = 16;

double TurnRad(const Pose2& motion) { return std::abs(motion.theta_rad); }
double TurnRad(const slam6d::Pose3& motion) { return slam6d::RotationAngle(motion.rotation); }

std::chrono::nanoseconds WaitOf(const SessionOptions& options) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(options.odometry_wait_s));
}

LatencySummary Summarize(const LatencyHistogram& histogram) {
  return {.median = histogram.Quantile(0.5),
          .p99 = histogram.Quantile(0.99),
          .longest = histogram.longest()};
}

}  // namespace

template <class Kind>
SessionIntake<Kind>::SessionIntake(RobotEvents events, const SessionOptions& options)
    : events_(std::move(events)),
      options_(options),
      queue_(static_cast<std::size_t>(options.queue_scans)) {}

template <class Kind>
void SessionIntake<Kind>::Join() {
  {
    const std::lock_guard lock(mutex_);
    if (IsHere()) return;
    is_interrupted_ = true;
    hears_odometry_ = false;
    first_arrived_.reset();
    const bool goes_on = state_ == RobotState::kLost && counts_.answered > 0;
    state_ = goes_on ? RobotState::kTracked : RobotState::kUnplaced;
  }
  events_.Inform("joined");
}

template <class Kind>
void SessionIntake<Kind>::Lose() {
  {
    const std::lock_guard lock(mutex_);
    if (!IsHere()) return;
    state_ = RobotState::kLost;
  }
  events_.Warn("is lost: nobody publishes its scans any more");
}

template <class Kind>
void SessionIntake<Kind>::HandOver() {
  {
    const std::lock_guard lock(mutex_);
    state_ = RobotState::kElsewhere;
    was_elsewhere_ = true;
    while (!queue_.empty()) queue_.Pop();
  }
  events_.Inform("is answered by another service");
}

template <class Kind>
bool SessionIntake<Kind>::IsHere() const {
  return state_ == RobotState::kUnplaced || state_ == RobotState::kTracked;
}

template <class Kind>
void SessionIntake<Kind>::ExpectWaited(std::size_t scans) {
  const std::lock_guard lock(mutex_);
  waited_ = scans;
}

template <class Kind>
bool SessionIntake<Kind>::Enqueue(Scan scan, const std::optional<Pose>& T_robot_sensor_claimed) {
  Join();
  const std::string_view malformed = ObjectionTo(scan);
  if (malformed.empty()) ThinOut(scan);
  std::string_view objection;
  {
    const std::lock_guard lock(mutex_);
    objection = Count(malformed, scan);
    if (objection.empty()) {
      Push({.scan = std::move(scan),
            .arrived = steady_clock::now(),
            .T_robot_sensor_claimed = T_robot_sensor_claimed});
      return true;
    }
    if (!told_objections_.insert(objection).second) return false;
  }
  events_.Warn("scans are refused: " + std::string(objection) +
               "; whoever publishes them has to mend that");
  return false;
}

// Whether it can be used; why not, else.
template <class Kind>
std::string_view SessionIntake<Kind>::Count(std::string_view malformed, const Scan& scan) {
  ++counts_.scans;
  heard_at_ = steady_clock::now();
  if (!malformed.empty()) {
    ++counts_.malformed;
    return malformed;
  }
  switch (GuardOf(scan).Judge(scan.stamp)) {
    case StampVerdict::kDuplicate:
      ++counts_.duplicates;
      return "their stamp is that of an earlier one";
    case StampVerdict::kWrongTime:
      ++counts_.wrong_time;
      return "their stamp is more than a second before the last one, or more than an hour ahead";
    case StampVerdict::kLate:
      ++counts_.late;
      break;
    case StampVerdict::kClockReset:
      ++counts_.clock_resets;
      is_interrupted_ = true;
      break;
    case StampVerdict::kInOrder:
      break;
  }
  return {};
}

// Scans that wait for odometry are not too many, nor those that come at once after a wait.
template <class Kind>
void SessionIntake<Kind>::Push(Arrival arrival) {
  const Lane::Time now = arrival.arrived;
  if (!first_arrived_) first_arrived_ = now;
  const bool has_waited = waited_ > 0;
  if (has_waited) --waited_;
  const bool others_wait = !queue_.empty() && ReadyAtOf(queue_.front()) > now;
  queue_.Push(std::move(arrival), has_waited || others_wait);
  counts_.dropped = queue_.dropped();
}

template <class Kind>
StampGuard& SessionIntake<Kind>::GuardOf(const Scan& scan) {
  const Pose& mounting = Kind::MountingOf(scan);
  const auto known = std::ranges::find_if(guards_, [&](const SensorStamps& sensor) {
    return Kind::IsSame(sensor.T_robot_sensor, mounting);
  });
  if (known != guards_.end()) return known->guard;
  if (guards_.size() == kMostSensors) guards_.pop_front();
  return guards_.emplace_back(SensorStamps{mounting, guard_}).guard;
}

/// Scans that are too heavy would cost the others their answers.
template <class Kind>
void SessionIntake<Kind>::ThinOut(Scan& scan) {
  const std::size_t step = Thin(scan, static_cast<std::size_t>(options_.max_readings));
  if (step == 1 || is_thinning_told_.exchange(true)) return;
  events_.Warn("sends more readings in a scan than team.session.max_readings: one in " +
               std::to_string(step) + " is used");
}

template <class Kind>
void SessionIntake<Kind>::TakeOdometry(Timestamp stamp, const Pose& T_odom_robot) {
  const std::lock_guard lock(mutex_);
  ++counts_.odometry_readings;
  expects_odometry_ = true;
  hears_odometry_ = true;
  if (!odometry_.Add(stamp, T_odom_robot)) ++counts_.odometry_refused;
}

template <class Kind>
void SessionIntake<Kind>::ExpectOdometry(bool expected) {
  const std::lock_guard lock(mutex_);
  expects_odometry_ = expected;
}

template <class Kind>
void SessionIntake<Kind>::TakeImu(const ImuReading& reading) {
  const std::lock_guard lock(mutex_);
  switch (imu_guard_.Judge(reading.stamp)) {
    case StampVerdict::kDuplicate:
    case StampVerdict::kWrongTime:
      return;
    case StampVerdict::kClockReset:
      gyro_.Restart();
      tilt_.Restart();
      break;
    case StampVerdict::kInOrder:
    case StampVerdict::kLate:
      break;
  }
  gyro_.Add(reading);
  tilt_.Add(reading);
}

template <class Kind>
void SessionIntake<Kind>::ExpectImu(bool expected) {
  const std::lock_guard lock(mutex_);
  expects_imu_ = expected;
}

template <class Kind>
void SessionIntake<Kind>::GoOnFrom(Timestamp stamp, const std::optional<Pose>& T_odom_robot) {
  const std::lock_guard lock(mutex_);
  static_cast<void>(guard_.Judge(stamp));  // If it comes once more it is a duplicate.
  last_stamp_ = stamp;
  T_odom_last_ = T_odom_robot;
}

template <class Kind>
std::optional<Lane::Time> SessionIntake<Kind>::ReadyAt() const {
  const std::lock_guard lock(mutex_);
  if (queue_.empty()) return std::nullopt;
  return ReadyAtOf(queue_.front());
}

template <class Kind>
Lane::Time SessionIntake<Kind>::ReadyAtOf(const Arrival& next) const {
  return std::max({next.arrived, AwaitsOdometryUntil(next), AwaitsImuUntil(next)});
}

// Until when the robot's motion has to be known for a scan.
template <class Kind>
Timestamp SessionIntake<Kind>::KnownUntil(const Arrival& next) const {
  return options_.deskew ? EndOf(next.scan) : next.scan.stamp;
}

template <class Kind>
Lane::Time SessionIntake<Kind>::AwaitsImuUntil(const Arrival& next) const {
  const Timestamp stamp = KnownUntil(next);
  const bool may_come = expects_imu_ && !gyro_.Covers(stamp) && gyro_.Covers(stamp - kOdometryGone);
  return next.arrived + (may_come ? WaitOf(options_) : std::chrono::nanoseconds::zero());
}

// Without odometry nobody knows how far a robot has come since it was heard last, so its first
// scans wait longer: they may have come just before who publishes odometry knew of this service.
template <class Kind>
Lane::Time SessionIntake<Kind>::AwaitsOdometryUntil(const Arrival& next) const {
  const Timestamp stamp = KnownUntil(next);
  if (!expects_odometry_ || odometry_.Covers(stamp)) return next.arrived;
  const std::chrono::nanoseconds wait = WaitOf(options_);
  if (!hears_odometry_)
    return first_arrived_.value_or(next.arrived) + std::max(wait, kOdometryGone);
  return next.arrived + (odometry_.Covers(stamp - kOdometryGone) ? wait : wait.zero());
}

template <class Kind>
std::optional<typename SessionIntake<Kind>::Work> SessionIntake<Kind>::Take() {
  std::unique_lock lock(mutex_);
  DropScansBeforeOdometry();
  if (queue_.empty()) return std::nullopt;
  Work work = Prepare(queue_.Pop());
  const std::array<std::string, 2> troubles = WatchClocks(work);
  lock.unlock();
  for (const std::string& trouble : troubles) {
    if (!trouble.empty()) events_.Warn(trouble);
  }
  return work;
}

template <class Kind>
typename SessionIntake<Kind>::Work SessionIntake<Kind>::Prepare(Arrival next) {
  LeaveOutFloorOf(tilt_, options_.laser_height_m, next.scan);
  next.scan = options_.deskew ? AsFromOnePlace(std::move(next.scan), odometry_, gyro_)
                              : WithoutTimes(std::move(next.scan));
  Work work{.scan = std::move(next.scan),
            .arrived = next.arrived,
            .T_odom_robot = {},
            .gyro_rad = {},
            .T_robot_sensor_claimed = next.T_robot_sensor_claimed};
  work.T_odom_robot = odometry_.At(work.scan.stamp);
  work.gyro_rad = gyro_.At(work.scan.stamp);
  work.is_interrupted = std::exchange(is_interrupted_, false);
  work.was_elsewhere = std::exchange(was_elsewhere_, false);
  WatchOdometry(work);
  return work;
}

// Whoever has only just found the robot may have missed the odometry of its first scan, which then
// tells less of where the robot is than the next one. Later ones would never have any: odometry is
// of another clock.
template <class Kind>
void SessionIntake<Kind>::DropScansBeforeOdometry() {
  const auto is_one_of_the_first = [this](const Arrival& next) {
    return next.arrived <=
           first_arrived_.value_or(next.arrived) + std::max(WaitOf(options_), kOdometryGone);
  };
  while (expects_odometry_ && !queue_.empty() && is_one_of_the_first(queue_.front()) &&
         odometry_.BeginsAfter(queue_.front().scan.stamp)) {
    queue_.Pop();
    ++counts_.unplaced;
  }
}

template <class Kind>
std::array<std::string, 2> SessionIntake<Kind>::WatchClocks(const Work& work) {
  const Timestamp stamp = work.scan.stamp;
  const bool lacks_odometry = expects_odometry_ && !work.T_odom_robot;
  const bool lacks_gyro = expects_imu_ && !gyro_.empty() && !work.gyro_rad;
  const bool is_gyro_apart =
      !gyro_.Covers(stamp - ClockWatch::kApart) || gyro_.Covers(stamp + ClockWatch::kApart);
  return {clocks_.NoteOdometry(lacks_odometry ? odometry_.Apart(stamp) : Timestamp{}),
          clocks_.NoteGyro(lacks_gyro && is_gyro_apart)};
}

template <class Kind>
void SessionIntake<Kind>::WatchOdometry(Work& work) {
  const Timestamp stamp = work.scan.stamp;
  work.odometry_goes_on = work.T_odom_robot && T_odom_last_;
  if (work.odometry_goes_on) {
    const Pose moved = T_odom_last_->Inverse() * *work.T_odom_robot;
    const double elapsed_s = std::abs(Seconds(stamp - last_stamp_));
    work.odometry_jumped = LengthM(moved) > kJump_m + options_.max_speed_mps * elapsed_s ||
                           TurnRad(moved) > kJump_rad + options_.max_turn_rate_radps * elapsed_s;
    if (work.odometry_jumped) ++counts_.odometry_jumps;
  }
  work.lacks_odometry = !work.T_odom_robot && expects_odometry_ && has_had_odometry_;
  has_had_odometry_ = has_had_odometry_ || work.T_odom_robot;
  T_odom_last_ = work.T_odom_robot;
  last_stamp_ = stamp;
}

template <class Kind>
void SessionIntake<Kind>::NoteContradictedPose() {
  const std::lock_guard lock(mutex_);
  ++counts_.contradicted_poses;
}

template <class Kind>
void SessionIntake<Kind>::NoteContradictedMounting() {
  const std::lock_guard lock(mutex_);
  ++counts_.contradicted_mountings;
}

template <class Kind>
SessionCounts SessionIntake<Kind>::NoteAnswer(const Outcome& outcome) {
  const std::lock_guard lock(mutex_);
  if (state_ == RobotState::kUnplaced) state_ = RobotState::kTracked;
  ++counts_.answered;
  if (outcome.is_dead_reckoned) ++counts_.dead_reckoned;
  counts_.relevant += outcome.relevant;
  if (!outcome.has_odometry) ++counts_.without_odometry;
  working_.Add(outcome.working);
  latency_.Add(steady_clock::now() - outcome.arrived);
  answered_stamp_ = outcome.stamp;
  map_robot_ = outcome.map_robot;
  return counts_;
}

template <class Kind>
RobotStatus SessionIntake<Kind>::Status() const {
  const std::lock_guard lock(mutex_);
  return {.name = name(),
          .state = state_,
          .map_robot = map_robot_,
          .stamp = answered_stamp_,
          .silence = heard_at_ ? steady_clock::now() - *heard_at_ : Timestamp{},
          .waiting = queue_.size(),
          .counts = counts_,
          .matching = Summarize(working_),
          .latency = Summarize(latency_)};
}

template class SessionIntake<Planar>;
template class SessionIntake<Spatial>;

}  // namespace qwsm::team
