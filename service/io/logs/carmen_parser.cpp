// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/carmen_parser.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "qwsm/sensor/scan_limits.hpp"
#include "service/io/logs/sweep_geometry.hpp"

namespace qwsm::io {
namespace {

using SweepLayout = CarmenParser::SweepLayout;

constexpr std::array kSweepLayouts{
    SweepLayout{"FLASER", "front", false, true},
    SweepLayout{"RLASER", "rear", false, true},
    SweepLayout{"LASER3", "laser3", false, false},
    SweepLayout{"LASER4", "laser4", false, false},
    SweepLayout{"LASER5", "laser5", false, false},
    SweepLayout{"RAWLASER1", "front", true, false},
    SweepLayout{"RAWLASER2", "rear", true, false},
    SweepLayout{"RAWLASER3", "laser3", true, false},
    SweepLayout{"RAWLASER4", "laser4", true, false},
    SweepLayout{"RAWLASER5", "laser5", true, false},
    SweepLayout{"ROBOTLASER1", "front", true, true},
    SweepLayout{"ROBOTLASER2", "rear", true, true},
    SweepLayout{"ROBOTLASER3", "laser3", true, true},
    SweepLayout{"ROBOTLASER4", "laser4", true, true},
    SweepLayout{"ROBOTLASER5", "laser5", true, true},
};

/// Messages of CARMEN's logger that say nothing about scans or odometry.
constexpr std::array<std::string_view, 13> kOtherMessages{"SYNC",
                                                          "COMMENT",
                                                          "MARKER",
                                                          "NMEAGGA",
                                                          "NMEARMC",
                                                          "SONAR",
                                                          "BUMPER",
                                                          "ARM",
                                                          "SCANMARK",
                                                          "POSITIONLASER",
                                                          "VELOCITY",
                                                          "VECTORMOVE",
                                                          "FOLLOWTRAJECTORY"};

const SweepLayout* LayoutOf(std::string_view message) {
  const auto* found = std::ranges::find(kSweepLayouts, message, &SweepLayout::message);
  return found == kSweepLayouts.end() ? nullptr : found;
}

/// `ipc_timestamp ipc_hostname logger_timestamp`: the first, unless it was never set. Old writers
/// leave out the last or the last two.
Timestamp ReadStamp(FieldReader& fields) {
  const Timestamp stamp = fields.Stamp();
  fields.Word();
  const std::string_view logger_stamp = fields.Word();
  fields.ExpectEnd();
  if (stamp != Timestamp{}) return stamp;
  return ParseStamp(logger_stamp).value_or(stamp);
}

/// After the poses of ROBOTLASER stand laser_tv, laser_rv, forward_safety_dist, side_safety_dist
/// and, in newer logs, turn_axis.
Timestamp ReadVelocitiesAndStamp(FieldReader& fields) {
  constexpr std::size_t kStampWords = 3;
  fields.Skip(fields.WordsLeft() == 5 + kStampWords ? 5 : 4);
  return ReadStamp(fields);
}

/// `laser_type start_angle field_of_view angular_resolution maximum_range accuracy remission_mode`
struct Configuration {
  double first_bearing_rad = 0.0;
  double field_of_view_rad = 0.0;
  double resolution_rad = 0.0;
  double range_max_m = 0.0;
};

Configuration ReadConfiguration(FieldReader& fields) {
  Configuration configuration;
  fields.Skip(1);
  configuration.first_bearing_rad = fields.Number();
  configuration.field_of_view_rad = fields.Number();
  configuration.resolution_rad = fields.Number();
  configuration.range_max_m = fields.Number();
  fields.Skip(2);
  return configuration;
}

/// Nothing where the configuration is none of a sweep.
std::optional<LaserGeometry> GeometryOf(const Configuration& configuration, std::size_t readings) {
  LaserGeometry geometry = GuessGeometry(readings, std::nullopt);
  geometry.range_max_m = StatedRangeMaximum(configuration.range_max_m);
  if (configuration.field_of_view_rad == 0.0 && configuration.resolution_rad == 0.0) {
    return geometry;
  }
  const std::optional<double> step_rad =
      BearingStep(configuration.field_of_view_rad, configuration.resolution_rad, readings);
  if (!step_rad) return std::nullopt;
  geometry.first_bearing_rad = static_cast<float>(NormalizeAngle(configuration.first_bearing_rad));
  geometry.bearing_step_rad = static_cast<float>(*step_rad);
  return geometry;
}

/// The number of a mounting that a parameter gives; null for other parameters.
double* Axis(Pose2& T_robot_laser, std::string_view parameter) {
  if (parameter == "_offset") return &T_robot_laser.x_m;
  if (parameter == "_side_offset") return &T_robot_laser.y_m;
  if (parameter == "_angular_offset") return &T_robot_laser.theta_rad;
  return nullptr;
}

ParsedLine ParseOdometry(FieldReader fields) {
  OdometryReading reading;
  reading.T_odom_robot = fields.Pose();
  fields.Skip(3);  // Speed, turn rate and acceleration.
  reading.stamp = ReadStamp(fields);
  if (fields.fault()) return MalformedLine{"ODOM", *fields.fault()};
  return reading;
}

ParsedLine ParseTruePose(FieldReader fields) {
  TruePoseReading reading;
  reading.T_world_robot = fields.Pose();
  reading.T_odom_robot = fields.Pose();
  reading.stamp = ReadStamp(fields);
  if (fields.fault()) return MalformedLine{"TRUEPOS", *fields.fault()};
  return reading;
}

Eigen::Vector3d ReadVector(FieldReader& fields) {
  Eigen::Vector3d vector;
  for (double& value : vector) value = fields.Number();
  return vector;
}

/// `accX accY accZ q0 q1 q2 q3 magX magY magZ gyroX gyroY gyroZ`, the scalar of the rotation first;
/// zeros stand for what is not measured.
ParsedLine ParseImu(FieldReader fields) {
  ImuReading reading;
  const Eigen::Vector3d acceleration_mps2 = ReadVector(fields);
  if (!acceleration_mps2.isZero(0.0)) reading.acceleration_mps2 = acceleration_mps2;
  Quaternion orientation;
  orientation.w = fields.Number();
  orientation.x = fields.Number();
  orientation.y = fields.Number();
  orientation.z = fields.Number();
  if (std::isfinite(UprightnessOf(orientation))) reading.orientation = orientation;
  fields.Skip(3);  // The magnetic field.
  reading.turn_rate_rad_s = ReadVector(fields);
  reading.stamp = ReadStamp(fields);
  if (!ObjectionTo(reading).empty()) fields.Fail(FieldFault::kTooFar);
  if (fields.fault()) return MalformedLine{"IMU", *fields.fault()};
  return reading;
}

}  // namespace

bool CarmenParser::Recognizes(std::string_view line) {
  if (line.starts_with("# CARMEN")) return true;
  const std::string_view message = FieldReader(line).Word();
  return LayoutOf(message) != nullptr || message == "ODOM" || message == "TRUEPOS" ||
         message == "PARAM" || message == "SYNC" || message == "IMU";
}

ParsedLine CarmenParser::Parse(std::string_view line) {
  FieldReader fields(line);
  const std::string_view message = fields.Word();
  if (message.empty() || message.starts_with('#')) return Comment{};
  if (const SweepLayout* layout = LayoutOf(message)) return ParseSweep(*layout, fields);
  if (message == "ODOM") return ParseOdometry(fields);
  if (message == "TRUEPOS") return ParseTruePose(fields);
  if (message == "IMU") return ParseImu(fields);
  if (message == "PARAM") return ParseParameter(fields);
  if (std::ranges::find(kOtherMessages, message) != kOtherMessages.end()) return OtherMessage{};
  if (!IsPrintable(message)) return MalformedLine{"line", FieldFault::kNotText};
  return UnknownMessage{message};
}

ParsedLine CarmenParser::ParseSweep(const SweepLayout& layout, FieldReader fields) const {
  const Configuration configuration =
      layout.configured ? ReadConfiguration(fields) : Configuration{};
  const std::size_t readings = fields.Count(1);
  Sweep sweep;
  sweep.message = layout.message;
  LaserScan& scan = sweep.reading.scan;
  scan.ranges_m = fields.Ranges(readings);
  if (layout.configured) fields.Skip(fields.Count(0));  // Remissions.
  if (layout.posed) {
    sweep.T_odom_laser = fields.Pose();
    sweep.reading.T_odom_robot = fields.Pose();
  }
  scan.stamp =
      layout.configured && layout.posed ? ReadVelocitiesAndStamp(fields) : ReadStamp(fields);
  if (fields.fault()) return MalformedLine{layout.message, *fields.fault()};

  const std::optional<LaserGeometry> geometry = layout.configured
                                                    ? GeometryOf(configuration, readings)
                                                    : GuessGeometry(readings, field_of_view_rad_);
  if (!geometry) return MalformedLine{layout.message, FieldFault::kBadGeometry};
  scan.geometry = *geometry;
  sweep.reading.laser = layout.laser;
  sweep.odd_readings = fields.odd_readings();
  if (const Mounting* mounting = MountingOf(layout.laser)) {
    scan.geometry.T_robot_laser = mounting->T_robot_laser;
    sweep.mounting_known = mounting->known;
  }
  return sweep;
}

/// `robot_frontlaser_offset 0.35`, with `_side_offset` and `_angular_offset` (radians), and the
/// same for the rear laser.
ParsedLine CarmenParser::ParseParameter(FieldReader fields) {
  const std::string_view name = fields.Word();
  const auto mounting = std::ranges::find_if(
      mountings_, [&](const Mounting& known) { return name.starts_with(known.parameter); });
  if (mounting == mountings_.end()) return OtherMessage{};
  const std::string_view axis = name.substr(mounting->parameter.size());
  if (Axis(mounting->T_robot_laser, axis) == nullptr) return OtherMessage{};
  const double number = fields.Number();
  if (fields.fault()) return MalformedLine{"PARAM", *fields.fault()};
  Pose2 T_robot_laser = mounting->T_robot_laser;
  *Axis(T_robot_laser, axis) = number;
  if (!IsMounting(T_robot_laser)) return MalformedLine{"PARAM", FieldFault::kTooFar};
  T_robot_laser.theta_rad = NormalizeAngle(T_robot_laser.theta_rad);
  mounting->T_robot_laser = T_robot_laser;
  mounting->known = true;
  return OtherMessage{};
}

const CarmenParser::Mounting* CarmenParser::MountingOf(std::string_view laser) const {
  const auto found = std::ranges::find(mountings_, laser, &Mounting::laser);
  return found == mountings_.end() ? nullptr : &*found;
}

}  // namespace qwsm::io
