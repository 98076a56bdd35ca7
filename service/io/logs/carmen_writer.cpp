// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/carmen_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string_view>
#include <utility>

#include "service/io/files/number_text.hpp"
#include "service/io/logs/sweep_geometry.hpp"

namespace qwsm::io {
namespace {

constexpr std::string_view kHeading =
    "# CARMEN Logfile\n"
    "# file format is one message per line\n"
    "# message_name [message contents] ipc_timestamp ipc_hostname logger_timestamp\n";

template <class... Values>
void AppendNumbers(std::string& line, Values... values) {
  ((line += ' ', AppendNumber(line, values)), ...);
}

void AppendPose(std::string& line, const Pose2& pose) {
  AppendNumbers(line, pose.x_m, pose.y_m, pose.theta_rad);
}

void AppendRanges(std::string& line, const LaserScan& scan) {
  line.append(" ").append(std::to_string(scan.size()));
  for (const float range_m : scan.ranges_m) AppendNumbers(line, range_m);
}

/// From right to left, as is guessed where bearings are not told.
void AppendRangesFromTheRight(std::string& line, LaserScan scan) {
  if (scan.geometry.bearing_step_rad < 0.0F) std::ranges::reverse(scan.ranges_m);
  AppendRanges(line, scan);
}

/// `laser_type start_angle field_of_view angular_resolution maximum_range accuracy remission_mode`
void AppendConfiguration(std::string& line, const LaserScan& scan) {
  const LaserGeometry& geometry = scan.geometry;
  const auto step_rad = static_cast<double>(geometry.bearing_step_rad);
  const auto steps = static_cast<double>(std::max<std::size_t>(scan.size(), 1) - 1);
  line += " 0";
  AppendNumbers(line, geometry.first_bearing_rad, steps * step_rad, step_rad, geometry.range_max_m);
  line += " 0.01 0";
}

/// CARMEN numbers its lasers: 1 looks forward, 2 back.
int NumberOf(std::string_view laser) {
  if (laser == "rear") return 2;
  const bool numbered = laser.starts_with("laser") && !laser.empty();
  const char last = numbered ? laser.back() : '1';
  if (laser.starts_with("laser:")) return last >= '0' && last <= '4' ? last - '0' + 1 : 1;
  return last >= '1' && last <= '5' ? last - '0' : 1;
}

}  // namespace

bool IsGuessedRightly(const LaserScan& scan) {
  if (scan.size() == 0) return true;
  const LaserGeometry guess = GuessGeometry(scan.size(), std::nullopt);
  const std::size_t last = scan.size() - 1;
  const auto [right_rad, left_rad] =
      std::minmax({scan.geometry.Bearing(0), scan.geometry.Bearing(last)});
  const double tolerance_rad = 0.5 * std::abs(static_cast<double>(scan.geometry.bearing_step_rad));
  return std::abs(guess.Bearing(0) - right_rad) <= tolerance_rad &&
         std::abs(guess.Bearing(last) - left_rad) <= tolerance_rad;
}

CarmenWriter::CarmenWriter(std::ostream& stream, CarmenDialect dialect)
    : stream_(&stream), dialect_(dialect) {
  *stream_ << kHeading;
}

void CarmenWriter::Write(const LogRecord& record) {
  if (const auto* scan = std::get_if<ScanReading>(&record)) WriteScan(*scan);
  if (const auto* odometry = std::get_if<OdometryReading>(&record)) WriteOdometry(*odometry);
  if (const auto* true_pose = std::get_if<TruePoseReading>(&record)) WriteTruePose(*true_pose);
  if (const auto* imu = std::get_if<ImuReading>(&record)) WriteImu(*imu);
}

void CarmenWriter::WriteScan(const ScanReading& reading) {
  const LaserScan& scan = reading.scan;
  const int number = NumberOf(reading.laser);
  WriteMounting(number, scan.geometry.T_robot_laser);
  const bool old = dialect_ == CarmenDialect::kFlaser && number <= 2 && reading.T_odom_robot;
  const std::string_view message = old                    ? "FLASER"
                                   : reading.T_odom_robot ? "ROBOTLASER"
                                                          : "RAWLASER";
  line_ = old && number == 2 ? "RLASER" : message;
  if (old) {
    AppendRangesFromTheRight(line_, scan);
  } else {
    line_ += std::to_string(number);
    AppendConfiguration(line_, scan);
    AppendRanges(line_, scan);
    line_ += " 0";  // Remissions.
  }
  if (reading.T_odom_robot) {
    AppendPose(line_, *reading.T_odom_robot * scan.geometry.T_robot_laser);
    AppendPose(line_, *reading.T_odom_robot);
    if (!old) line_ += " 0 0 0 0 0";  // Speeds, safety distances, turn axis.
  }
  AppendStampAndHost(scan.stamp);
}

void CarmenWriter::WriteOdometry(const OdometryReading& reading) {
  line_ = "ODOM";
  AppendPose(line_, reading.T_odom_robot);
  line_ += " 0 0 0";  // Speeds and acceleration.
  AppendStampAndHost(reading.stamp);
}

void CarmenWriter::WriteTruePose(const TruePoseReading& reading) {
  line_ = "TRUEPOS";
  AppendPose(line_, reading.T_world_robot);
  AppendPose(line_, reading.T_odom_robot.value_or(Pose2{}));
  AppendStampAndHost(reading.stamp);
}

void CarmenWriter::WriteImu(const ImuReading& reading) {
  line_ = "IMU";
  const Eigen::Vector3d acceleration_mps2 =
      reading.acceleration_mps2.value_or(Eigen::Vector3d::Zero());
  for (const double value : acceleration_mps2) AppendNumbers(line_, value);
  const Quaternion q = reading.orientation.value_or(Quaternion{0.0, 0.0, 0.0, 0.0});
  AppendNumbers(line_, q.w, q.x, q.y, q.z);
  line_ += " 0 0 0";  // The magnetic field.
  for (const double value : reading.turn_rate_rad_s) AppendNumbers(line_, value);
  AppendStampAndHost(reading.stamp);
}

/// As parameters: from the poses of a line it would come back with their rounding.
void CarmenWriter::WriteMounting(int laser_number, const Pose2& T_robot_laser) {
  if (laser_number > 2) return;
  const auto [written, is_new] = T_robot_laser_.try_emplace(laser_number, T_robot_laser);
  if (!is_new && written->second == T_robot_laser) return;
  written->second = T_robot_laser;
  const std::string_view name = laser_number == 1 ? "robot_frontlaser" : "robot_rearlaser";
  const std::array axes{std::pair{"_offset", T_robot_laser.x_m},
                        std::pair{"_side_offset", T_robot_laser.y_m},
                        std::pair{"_angular_offset", T_robot_laser.theta_rad}};
  for (const auto& [axis, value] : axes) {
    line_ = "PARAM ";
    line_.append(name).append(axis);
    AppendNumbers(line_, value);
    line_ += " qwsm 0\n";
    *stream_ << line_;
  }
}

/// Ends the line with `ipc_timestamp ipc_hostname logger_timestamp`, the last since the log began.
void CarmenWriter::AppendStampAndHost(Timestamp stamp) {
  if (!first_stamp_) first_stamp_ = stamp;
  line_ += ' ';
  AppendStamp(line_, stamp);
  line_ += " qwsm ";
  AppendStamp(line_, std::max(Timestamp::zero(), stamp - *first_stamp_));
  line_ += '\n';
  *stream_ << line_;
}

}  // namespace qwsm::io
