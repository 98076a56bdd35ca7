// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "service/dds/entities/reader.hpp"
#include "service/dds/robot/imu_inbox.hpp"
#include "service/dds/robot/source_watch.hpp"
#include "service/dds/wire/refusals.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/static_transforms.hpp"
#include "service/team/session/robot_listener.hpp"

namespace qwsm::dds {

/// Hears what one robot says: scans, odometry, its inertial sensor, and where its operator says it
/// is.
template <class Kind>
class BasicRobotInbox {
 public:
  /// Subscribes to a robot's topics.
  /// @param scan_topics below its namespace; several lasers may have one each, or share one.
  /// @param scans the profile its scans are read with.
  /// @param refusals outlives this.
  BasicRobotInbox(const Participant& participant,
                  const RobotNames& names,
                  Refusals& refusals,
                  const std::vector<std::string>& scan_topics,
                  Profile scans = Profile::kSensorIn);

  std::vector<Entity::Handle> handles() const;
  /// Whether there is something that waits to be told where its sensor sits.
  bool is_waiting() const { return !unplaced_.empty() || (imu_ && imu_->is_waiting()); }

  /// Takes the scans that have arrived. To be called before transforms and odometry are taken:
  /// robots tell these before the scan, so that whose scan is here has them here, too.
  void HoldScans();
  /// Delivers the scans that HoldScans() took and all else that has arrived: odometry first, for
  /// scans are matched with it.
  void Deliver(const BasicStaticTransforms<Kind>& transforms, team::RobotListener<Kind>& listener);

 private:
  /// Where a sensor sits on its robot, as far as that is told.
  struct Placement {
    typename Kind::Pose T_robot_sensor;
    bool is_told = false;  // Else nobody says where the sensor sits.
    bool is_upside_down = false;
    bool is_tilted = false;  // Nothing in the plane can be made of what it sees.
  };

  void HearOdometry(team::RobotListener<Kind>& listener);
  void TakeOdometry(const wire::Odometry& sample, team::RobotListener<Kind>& listener);
  void TellOfFrame(std::string_view odometry_frame);
  struct ScanTopic;
  void HoldScan(const ScanTopic& topic,
                const typename OnWire<Kind>::Scan& sample,
                const Guid& source);
  void LeaveOutOldest();
  void DeliverPlacedScans(const BasicStaticTransforms<Kind>& transforms,
                          team::RobotListener<Kind>& listener);
  void TakeInitialPose(const wire::PoseWithCovarianceStamped& sample,
                       team::RobotListener<Kind>& listener);
  std::string ObjectionToFrame(std::string_view frame);
  struct UnplacedScan;
  void DeliverScan(UnplacedScan unplaced,
                   const Placement& placement,
                   team::RobotListener<Kind>& listener);
  Placement PlacementInUse(const std::string& sensor_frame, const Placement& placement);
  void TellOfUnplaced(const UnplacedScan& unplaced);
  std::optional<Placement> SensorOnRobot(const std::string& sensor_frame,
                                         const BasicStaticTransforms<Kind>& transforms);
  std::set<Guid> Own() const;
  std::optional<Placement> FindSensor(const std::string& sensor_frame,
                                      const BasicStaticTransforms<Kind>& transforms);

  double HeightOf_m(const std::string& sensor_frame,
                    const BasicStaticTransforms<Kind>& transforms) const;

  /// A scan that waits until it is known where its sensor sits.
  struct UnplacedScan {
    typename Kind::Scan scan;
    std::string sensor_frame;
    const std::string* topic;
    bool has_waited = false;
  };

  RobotNames names_;
  Refusals& refusals_;
  std::string robot_frame_;
  Reader<wire::Odometry> odometry_;
  SourceWatch odometry_sources_;
  bool is_frame_told_ = false;  // Whether it was told that odometry is in another frame.
  struct ScanTopic {
    std::string name;
    Reader<typename OnWire<Kind>::Scan> reader;
  };
  std::deque<ScanTopic> scans_;
  Reader<wire::PoseWithCovarianceStamped> initial_poses_;
  std::optional<ImuInbox> imu_;  // Where it is of use.
  std::deque<UnplacedScan> unplaced_;
  // Since when each frame's place is missing.
  std::map<std::string, std::chrono::steady_clock::time_point> missing_since_;
  bool has_publisher_ = false;       // Whether somebody publishes scans.
  std::set<std::string> overruled_;  // Frames of which strangers say something else.
  // By frame, the place its first scans were sent with.
  std::map<std::string, Placement> mountings_;
  std::set<std::string> unplaced_frames_;  // Frames of which it was told that nobody places them.
  std::map<std::string, SourceWatch> scan_sources_;  // By topic and frame.
  std::string foreign_frame_;  // The first that a place was told in which is not the map's.
};

using RobotInbox = BasicRobotInbox<team::Planar>;
using CloudRobotInbox = BasicRobotInbox<team::Spatial>;

extern template class BasicRobotInbox<team::Planar>;
extern template class BasicRobotInbox<team::Spatial>;

}  // namespace qwsm::dds
