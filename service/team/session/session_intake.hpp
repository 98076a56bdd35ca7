// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "qwsm/sensor/gyro_track.hpp"
#include "qwsm/sensor/tilt_track.hpp"
#include "service/team/scans/sensor_kind.hpp"
#include "service/team/session/clock_watch.hpp"
#include "service/team/session/latency_histogram.hpp"
#include "service/team/session/odometry_buffer.hpp"
#include "service/team/session/scan_queue.hpp"
#include "service/team/session/session_options.hpp"
#include "service/team/session/stamp_guard.hpp"
#include "service/team/session/worker_pool.hpp"
#include "service/team/sinks/robot_events.hpp"
#include "service/team/sinks/team_status.hpp"

namespace qwsm::team {

/// Keeps account of one robot's messages before its scans are worked on: taken from any thread,
/// refused, kept in order, joined with odometry, dropped where there are too many.
/// @tparam Kind Planar or Spatial.
template <class Kind>
class SessionIntake {
 public:
  using Scan = typename Kind::Scan;
  using Pose = typename Kind::Pose;

  /// A scan and what is known of its moment.
  struct Work {
    Scan scan;
    Lane::Time arrived{};
    std::optional<Pose> T_odom_robot;
    std::optional<double> gyro_rad;              ///< As in Observation.
    std::optional<Pose> T_robot_sensor_claimed;  ///< Claim of RobotListener::TakeContestedScan().
    bool is_interrupted = false;  ///< The robot, or its clock, was away since the last scan.
    bool was_elsewhere = false;   ///< Whether another service knows better where the robot is.
    /// Whether odometry moved faster than any robot: it began anew.
    bool odometry_jumped = false;
    bool odometry_goes_on = false;  ///< Whether the scan before had odometry, too.
    /// Whether it has none though somebody publishes it and earlier scans had some.
    bool lacks_odometry = false;
  };

  /// The outcome of one scan.
  struct Outcome {
    Timestamp stamp{};
    UncertainPose2 map_robot{};
    Lane::Time arrived{};
    std::chrono::nanoseconds working{};
    bool is_dead_reckoned = false;
    std::size_t relevant = 0;  ///< Scans that the map is extended with now.
    bool has_odometry = false;
  };

  SessionIntake(RobotEvents events, const SessionOptions& options);

  const std::string& name() const { return events_.robot(); }

  /// Notes that the robot's publisher is there, perhaps again.
  void Join();
  /// Notes that the robot's publisher is gone: it will come back where it left.
  void Lose();
  /// Notes that another service answers the robot from now on, until it joins again.
  void HandOver();

  /// See RobotListener::ExpectWaited().
  void ExpectWaited(std::size_t scans);
  /// Takes a scan; whoever sends scans has joined. One that is taken may still be dropped for newer
  /// ones.
  /// @return false if the scan was refused.
  bool Enqueue(Scan scan, const std::optional<Pose>& T_robot_sensor_claimed = {});
  void TakeOdometry(Timestamp stamp, const Pose& T_odom_robot);
  /// Says whether scans are to wait for odometry. They wait from the first reading on.
  void ExpectOdometry(bool expected);
  void TakeImu(const ImuReading& reading);
  /// Says whether scans are to wait for the inertial sensor, once it was heard.
  void ExpectImu(bool expected);

  /// Goes on from a scan that a run before this one took, with its stamp and odometry.
  void GoOnFrom(Timestamp stamp, const std::optional<Pose>& T_odom_robot);

  /// When the next scan can be worked on; nothing where none waits.
  std::optional<Lane::Time> ReadyAt() const;
  /// The oldest scan that waits and can be used. To be called by one thread at a time.
  std::optional<Work> Take();

  /// Notes that the robot's scans contradict where it was told to be.
  void NoteContradictedPose();
  /// Notes that the robot's scans contradict where its sensor was said to sit.
  void NoteContradictedMounting();
  /// Notes an answer. @return the robot's counts with it.
  SessionCounts NoteAnswer(const Outcome& outcome);

  RobotStatus Status() const;

 private:
  struct Arrival {
    Scan scan;
    Lane::Time arrived{};
    std::optional<Pose> T_robot_sensor_claimed;
  };

  /// Sensors of one robot have stamps of their own; they are told apart by where they sit.
  struct SensorStamps {
    Pose T_robot_sensor;
    StampGuard guard;
  };

  static constexpr std::size_t kImuReadingsKept = 4096;

  std::string_view Count(std::string_view malformed, const Scan& scan);
  void Push(Arrival arrival);
  StampGuard& GuardOf(const Scan& scan);
  bool IsHere() const;
  void ThinOut(Scan& scan);
  Lane::Time ReadyAtOf(const Arrival& next) const;
  Lane::Time AwaitsOdometryUntil(const Arrival& next) const;
  Lane::Time AwaitsImuUntil(const Arrival& next) const;
  Timestamp KnownUntil(const Arrival& next) const;
  void DropScansBeforeOdometry();
  Work Prepare(Arrival next);
  void WatchOdometry(Work& work);
  std::array<std::string, 2> WatchClocks(const Work& work);

  const RobotEvents events_;
  const SessionOptions options_;
  std::atomic<bool> is_thinning_told_ = false;

  mutable std::mutex mutex_;  // Guards what follows.
  RobotState state_ = RobotState::kExpected;
  StampGuard guard_;  // Of a sensor that was not heard yet.
  std::deque<SensorStamps> guards_;
  OdometryBuffer<Pose> odometry_;
  GyroTrack gyro_{kImuReadingsKept};
  TiltTrack tilt_{kImuReadingsKept};
  StampGuard imu_guard_;
  bool expects_imu_ = false;
  bool expects_odometry_ = false;
  bool hears_odometry_ = false;    // Whether there was odometry since the robot joined.
  bool has_had_odometry_ = false;  // Whether a scan had some.
  ClockWatch clocks_;
  std::optional<Lane::Time> heard_at_;       // When the last scan came.
  std::optional<Lane::Time> first_arrived_;  // Arrival of the first scan since the robot joined.
  ScanQueue<Arrival> queue_;
  std::size_t waited_ = 0;                      // Of the scans that come next, so many had to wait.
  std::set<std::string_view> told_objections_;  // Literals.
  bool is_interrupted_ = false;
  bool was_elsewhere_ = false;
  std::optional<Pose> T_odom_last_;  // Odometry of the scan taken last.
  Timestamp last_stamp_{};
  SessionCounts counts_;
  LatencyHistogram working_;
  LatencyHistogram latency_;
  Timestamp answered_stamp_{};
  UncertainPose2 map_robot_;
};

extern template class SessionIntake<Planar>;
extern template class SessionIntake<Spatial>;

}  // namespace qwsm::team
