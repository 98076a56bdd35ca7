// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "service/dds/entities/profile.hpp"
#include "service/dds/wire/cloud_conversion.hpp"
#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"
#include "service/dds/wire/spatial.hpp"
#include "service/team/scans/sensor_kind.hpp"

namespace qwsm::dds {

/// Says how what a robot says, and is told, looks on the wire: all that the readers and writers of
/// scans and of clouds do not have in common.
template <class Kind>
struct OnWire;

template <>
struct OnWire<team::Planar> {
  using Scan = wire::LaserScan;
  using WireReport = wire::MatchReport;
  static constexpr std::string_view kScanTopic = dds::kScanTopic;
  static constexpr std::string_view kReportTopic = dds::kReportTopic;
  static constexpr const char* kScanType = kLaserScanType;
  static constexpr bool kUsesImu = true;
  static constexpr const char* kReportType = kMatchReportType;

  /// The profile scans are read with.
  /// @param is_reliable whether their publisher repeats lost ones.
  static Profile ScansIn(bool) { return Profile::kSensorIn; }
  static Pose2 PoseOf(const wire::Pose& pose) { return FromWire(pose); }
  static bool IsRotation(const wire::Quaternion& q) { return std::isfinite(UprightnessOf(q)); }
  /// Whether a frame is turned about the z axis alone, tilted by less than 2.6 degrees
  /// (arccos 0.999).
  static bool IsUpright(const wire::Quaternion& turn) { return UprightnessOf(turn) > 0.999; }
  /// The same of one that may be upside down.
  static bool IsLevel(const wire::Quaternion& turn) {
    return std::abs(UprightnessOf(turn)) > 0.999;
  }
  static Eigen::Matrix3d CovarianceOf(const double (&of_six)[36]) {
    return PlanarCovariance(of_six);
  }

  static LaserScan ScanOf(const wire::LaserScan& sample) { return FromWire(sample, Pose2{}); }
  static Pose2& Mounting(LaserScan& scan) { return scan.geometry.T_robot_laser; }
  static const Pose2& Mounting(const LaserScan& scan) { return scan.geometry.T_robot_laser; }
  /// Makes a scan of a laser that is upside down one as seen from above, where the laser looks to
  /// the other side and turns the other way.
  static void TurnOver(LaserScan& scan) {
    scan.geometry.first_bearing_rad = -scan.geometry.first_bearing_rad;
    scan.geometry.bearing_step_rad = -scan.geometry.bearing_step_rad;
  }

  /// A scan as a sample, which points into the scan and the name of the frame.
  class Sample {
   public:
    Sample(const LaserScan& scan, const std::string& frame) : sample_(ToWire(scan, frame)) {}
    const wire::LaserScan& sample() const { return sample_; }

   private:
    wire::LaserScan sample_;
  };
};

template <>
struct OnWire<team::Spatial> {
  using Scan = wire::PointCloud2;
  using WireReport = wire::RegistrationReport;
  static constexpr std::string_view kScanTopic = dds::kCloudTopic;
  static constexpr std::string_view kReportTopic = dds::kRegistrationTopic;
  static constexpr const char* kScanType = kPointCloudType;
  static constexpr bool kUsesImu = false;
  static constexpr const char* kReportType = kRegistrationReportType;

  /// The profile clouds are read with. A cloud is a thousand packets: where the publisher repeats
  /// lost ones it is asked to, and one that does not is heard all the same.
  static Profile ScansIn(bool is_reliable) {
    return is_reliable ? Profile::kSensorInWhole : Profile::kSensorIn;
  }
  static slam6d::Pose3 PoseOf(const wire::Pose& pose) { return SpatialPose(pose); }
  static bool IsRotation(const wire::Quaternion& q) {
    return slam6d::RotationFromQuaternion({q.x, q.y, q.z, q.w}).allFinite();
  }
  static bool IsUpright(const wire::Quaternion&) { return true; }
  static bool IsLevel(const wire::Quaternion&) { return true; }
  static slam6d::Matrix6d CovarianceOf(const double (&of_six)[36]) {
    return SpatialCovariance(of_six);
  }

  static team::CloudScan ScanOf(const wire::PointCloud2& sample) { return FromWire(sample); }
  static slam6d::Pose3& Mounting(team::CloudScan& scan) { return scan.T_robot_sensor; }
  static const slam6d::Pose3& Mounting(const team::CloudScan& scan) { return scan.T_robot_sensor; }

  /// A cloud as a sample, in double precision: nothing of it is lost.
  class Sample {
   public:
    Sample(const team::CloudScan& scan, const std::string& frame)
        : sample_(scan.cloud, CloudPrecision::kDouble, scan.stamp, frame) {}
    const wire::PointCloud2& sample() const { return sample_.sample(); }

   private:
    CloudSample sample_;
  };
};

}  // namespace qwsm::dds
