// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/assembly/bag_reader.hpp"

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

#include "qwsm/sensor/deskew.hpp"
#include "qwsm/sensor/floor.hpp"
#include "qwsm/sensor/scan_limits.hpp"
#include "service/io/bags/assembly/stamp_doubts.hpp"
#include "service/io/bags/messages/message_reader.hpp"
#include "service/io/files/number_text.hpp"

namespace qwsm::io {
namespace {

LaserScan ScanOf(LaserScanMessage message, const LaserChoice& laser, const LogOptions& options) {
  // From above, an upside-down laser looks to the other side and turns the other way.
  const float side = laser.is_upside_down != options.mirrored ? -1.0F : 1.0F;
  return {.stamp = message.header.stamp,
          .geometry = {.first_bearing_rad = side * message.first_bearing_rad,
                       .bearing_step_rad = side * BearingStepOf(message),
                       .range_min_m = message.range_min_m,
                       .range_max_m = RangeMaximumOf_m(message.range_max_m),
                       .T_robot_laser = laser.T_robot_laser},
          .ranges_m = std::move(message.ranges_m)};
}

/// Time from the first beam to the last, as the message or the options tell, who are taken as
/// exactly as a message tells it; 0 where none does.
std::chrono::nanoseconds SweepOf(const LaserScanMessage& message, const LogOptions& options) {
  const double gaps = static_cast<double>(message.ranges_m.size()) - 1.0;
  const float step_s =
      options.sweep_s ? static_cast<float>(*options.sweep_s / gaps) : message.time_step_s;
  return StatedSweep(static_cast<double>(step_s) * gaps);
}

/// What mends range limits that no laser has; nothing where they are right.
std::string AdviceOnRanges(const LaserGeometry& geometry) {
  const bool are_limits = geometry.range_min_m >= 0.0F &&
                          geometry.range_min_m < geometry.range_max_m &&
                          geometry.range_max_m <= kLongestRange_m;
  if (are_limits) return "";
  std::string advice = ": they are ";
  AppendNumber(advice, geometry.range_min_m);
  advice += " and ";
  AppendNumber(advice, geometry.range_max_m);
  return advice + "; --set log.range_max_m=30, or what the laser reaches, mends the maximum";
}

std::chrono::nanoseconds OffsetOf(const LogOptions& options) {
  return std::chrono::round<std::chrono::nanoseconds>(
      std::chrono::duration<double>(options.stamp_offset_s));
}

}  // namespace

BagReader::BagReader(std::span<const std::filesystem::path> paths, const LogOptions& options)
    : options_(options), faults_(report_, options_) {
  report_.name = paths.front().string();
  if (paths.size() > 1) report_.name += " and " + std::to_string(paths.size() - 1) + " more";
  report_.line_name = "messages";
  contents_ = Survey(paths, report_, faults_);
  report_.format = contents_.files.front().messages().format();
  report_.compression = contents_.files.front().compression();
  if (options_.field_of_view_rad) {
    faults_.Doubt(
        "log.field_of_view_deg is left out: scans of a bag say themselves how far they go");
  }
  choice_ = ChooseRobot(contents_, options_, report_, faults_);
  for (const ImuReading& reading : choice_.imu) {
    gyro_.Add(reading);
    tilt_.Add(reading);
  }
  TakePlaces();
  TellOfOdometry();
  contents_.transforms.clear();
  contents_.odometry.clear();
  contents_.imus.clear();
  TellOfOthers();
}

/// Counts the messages that are of no use here, and tells of which types they are.
void BagReader::TellOfOthers() {
  std::string types;
  for (const auto& [type, count] : report_.unknown_messages) {
    report_.other_messages += count;
    types += (types.empty() ? "" : ", ") + std::to_string(count) + " of " + type;
    if (type == "rosgraph_msgs/Clock") types += " (time is that of the stamps in headers)";
  }
  if (!types.empty()) report_.notes.push_back("messages that are not needed: " + types);
}

/// Lists the scans of all lasers in the order of their stamps.
void BagReader::TakePlaces() {
  for (auto& [topic, scans] : contents_.scans) {
    const auto laser = std::ranges::find(choice_.lasers, topic, &LaserChoice::topic);
    if (laser == choice_.lasers.end()) {
      report_.other_scans += scans.places.size();
      continue;
    }
    DoubtStampsThatFallBack(topic, scans.places, faults_);
    const auto number = static_cast<std::size_t>(laser - choice_.lasers.begin());
    for (MessagePlace place : scans.places) {
      place.stamp += OffsetOf(options_);
      places_.push_back({.scan = place, .laser = number});
    }
  }
  contents_.scans.clear();
  std::ranges::sort(places_, {}, [](const Place& place) {
    return std::tuple(place.scan.stamp, place.scan.sequence);
  });
}

void BagReader::TellOfOdometry() {
  std::vector<MessagePlace> scans;
  for (const Place& place : places_) scans.push_back(place.scan);
  DoubtScansWithoutOdometry(scans, choice_.odometry, faults_);
}

void BagReader::TellOfBearings(const LaserScanMessage& message, const std::string& topic) {
  if (told_of_bearings_ || !ContradictsItself(message)) return;
  told_of_bearings_ = true;
  faults_.Doubt("the bearings of " + topic +
                " contradict each other: " + std::to_string(message.ranges_m.size()) +
                " beams from " + std::to_string(message.first_bearing_rad) + " to " +
                std::to_string(message.last_bearing_rad) + " rad, " +
                std::to_string(message.bearing_step_rad) +
                " rad from one to the next: the last is what counts");
}

/// The next reading of a track, if it is not later than `until`.
std::optional<OdometryReading> BagReader::NextOf(const OdometryTrack& track,
                                                 std::size_t next,
                                                 Timestamp until) const {
  if (next >= track.size() || track.reading(next).stamp > until) return std::nullopt;
  return track.reading(next);
}

/// Whether what was given of the inertial sensor does not reach up to a moment yet.
bool BagReader::IsImuDue(Timestamp until) const {
  return next_imu_ < choice_.imu.size() &&
         (next_imu_ == 0 || choice_.imu[next_imu_ - 1].stamp < until);
}

std::optional<LogRecord> BagReader::Next() {
  const Timestamp until =
      next_scan_ < places_.size() ? places_[next_scan_].scan.stamp : Timestamp::max();
  if (const auto truth = NextOf(choice_.truth, next_truth_, until)) {
    ++next_truth_;
    ++report_.true_poses;
    return TruePoseReading{.stamp = truth->stamp,
                           .T_world_robot = truth->T_odom_robot,
                           .T_odom_robot = choice_.odometry.At(truth->stamp, 0)};
  }
  if (const auto odometry = NextOf(choice_.odometry, next_odometry_, until)) {
    ++next_odometry_;
    ++report_.odometry_readings;
    return *odometry;
  }
  if (IsImuDue(until)) {
    ++report_.imu_readings;
    return choice_.imu[next_imu_++];
  }
  return NextScan();
}

/// The next scan that can be used.
std::optional<LogRecord> BagReader::NextScan() {
  while (next_scan_ < places_.size()) {
    const Place& place = places_[next_scan_++];
    const std::string& topic = choice_.lasers[place.laser].topic;
    try {
      ScanReading reading = ReadScan(place);
      const std::string_view objection = ObjectionTo(reading.scan);
      if (!objection.empty()) {
        throw MessageError(std::string(objection) + AdviceOnRanges(reading.scan.geometry));
      }
      BringToOnePlace(reading);
      ++report_.scans;
      return reading;
    } catch (const MessageError& error) {
      faults_.OfMessage(topic, place.scan.sequence, error.what());
    }
  }
  TellOfFloor();
  return std::nullopt;
}

/// Brings the beams of a scan to the robot's place at its stamp, where they have times and odometry
/// tells how the robot moved meanwhile; of who wants it as measured, tells that motion. A scan
/// without odometry keeps the times of its beams, for who finds out how the robot moves.
void BagReader::BringToOnePlace(ScanReading& reading) const {
  LaserScan& scan = reading.scan;
  if (scan.sweep.count() <= 0 || !reading.T_odom_robot) return;
  const Timestamp end = scan.stamp + scan.sweep;
  const std::optional<Pose2> T_odom_end = choice_.odometry.At(end, 0);
  if (!T_odom_end) {
    scan.sweep = {};
    return;
  }
  if (options_.as_measured) {
    reading.T_odom_end = T_odom_end;
    return;
  }
  Pose2 T_first_last = reading.T_odom_robot->Inverse() * *T_odom_end;
  const std::optional<double> gyro_first_rad = gyro_.At(scan.stamp);
  const std::optional<double> gyro_last_rad = gyro_.At(end);
  // Its bias does not count within a scan.
  if (gyro_first_rad && gyro_last_rad) {
    T_first_last.theta_rad = NormalizeAngle(*gyro_last_rad - *gyro_first_rad);
  }
  scan = Deskewed(scan, T_first_last);
}

/// @param height_m 0 where it is not known
void BagReader::LeaveOutFloorOf(double height_m, LaserScan& scan) {
  const std::optional<Tilt> tilt = tilt_.At(scan.stamp);
  if (!tilt || height_m <= 0.0) return;
  const std::size_t left_out = LeaveOutFloor(*tilt, height_m, scan);
  floor_beams_ += left_out;
  leaning_scans_ += left_out > 0 ? 1 : 0;
}

/// Tells once, at the end, of beams that were left out.
void BagReader::TellOfFloor() {
  if (floor_beams_ == 0) return;
  report_.notes.push_back("the robot leant in " + std::to_string(leaning_scans_) +
                          " scans: " + std::to_string(std::exchange(floor_beams_, 0)) +
                          " beams that may have hit the floor are left out");
}

ScanReading BagReader::ReadScan(const Place& place) {
  MessageSource& messages = contents_.files[place.scan.file].messages();
  const Encoding encoding = messages.topics()[place.scan.topic].encoding;
  const std::string_view bytes = PlainMessage(messages.Read(place.scan.address), buffer_);
  const LaserChoice& laser = choice_.lasers[place.laser];
  LaserScanMessage message = DecodeLaserScan(bytes, encoding);
  TellOfBearings(message, laser.topic);
  const std::chrono::nanoseconds sweep = SweepOf(message, options_);
  ScanReading reading{.scan = ScanOf(std::move(message), laser, options_),
                      .T_odom_robot = choice_.odometry.At(place.scan.stamp, place.scan.sequence),
                      .laser = laser.name};
  reading.scan.stamp = place.scan.stamp;
  reading.scan.sweep = sweep;
  LaserGeometry& geometry = reading.scan.geometry;
  if (options_.range_max_m) geometry.range_max_m = *options_.range_max_m;
  if (options_.T_robot_laser) geometry.T_robot_laser = *options_.T_robot_laser;
  LeaveOutFloorOf(options_.laser_height_m.value_or(laser.height_m), reading.scan);
  return reading;
}

LogProgress BagReader::progress() const {
  return {.bytes_read = next_scan_, .bytes_total = places_.size()};
}

}  // namespace qwsm::io
