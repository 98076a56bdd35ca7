// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/robot_inbox.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

#include "qwsm/geometry/position.hpp"
#include "qwsm/geometry/quaternion.hpp"
#include "service/dds/wire/wire_kind.hpp"
#include "slam6d/geometry/position.hpp"

namespace qwsm::dds {
namespace {

// A transform that is not there after this long will not come.
constexpr auto kPatienceForTransforms = std::chrono::seconds(1);
constexpr std::size_t kMaxUnplaced = 160;  // Those of four lasers at 40 Hz in that time.
constexpr std::size_t kMaxFrames = 256;
constexpr std::size_t kMostUnplacedTold = 16;  // Anybody may send scans of any number of frames.

template <class Kind>
std::string_view ObjectionToPose(const wire::Header& header, const wire::Pose& pose) {
  if (!FromWire(header.stamp)) return "its stamp is no time";
  if (!OnWire<Kind>::IsRotation(pose.orientation)) return "its orientation is no rotation";
  if (!IsPosition(OnWire<Kind>::PoseOf(pose))) {
    return "its pose is not finite, or more than 10000 km away";
  }
  return {};
}

/// Takes all samples, with who sent each: all zeros where it can be only one, who is not asked for.
template <class Sample, class Take>
void TakeAllFrom(const Reader<Sample>& reader, const Take& take) {
  if (reader.writer_count() < 2) {
    reader.TakeAll([&](const Sample& sample) { take(sample, Guid{}); });
  } else {
    reader.TakeAllWithSource(take);
  }
}

std::string SeveralPublish(const std::string& what) {
  return "two participants publish " + what +
         " in turns, and what both say is mixed: each robot needs a namespace of its own, such as "
         "/robot1";
}

}  // namespace

template <class Kind>
BasicRobotInbox<Kind>::BasicRobotInbox(const Participant& participant,
                                       const RobotNames& names,
                                       Refusals& refusals,
                                       const std::vector<std::string>& scan_topics,
                                       Profile scans)
    : names_(names),
      refusals_(refusals),
      robot_frame_(names.Frame(kRobotFrame)),
      odometry_(participant, names.Topic(kOdometryTopic), Profile::kSensorIn),
      initial_poses_(participant, names.Topic(kInitialPoseTopic), Profile::kSensorIn) {
  for (const std::string& topic : scan_topics) {
    const std::string name = names.Topic(topic);
    scans_.push_back({.name = name, .reader = {participant, name, scans}});
  }
  if constexpr (OnWire<Kind>::kUsesImu) imu_.emplace(participant, names, refusals);
}

template <class Kind>
std::vector<Entity::Handle> BasicRobotInbox<Kind>::handles() const {
  std::vector<Entity::Handle> handles{odometry_.handle(), initial_poses_.handle()};
  for (const ScanTopic& topic : scans_) handles.push_back(topic.reader.handle());
  if (imu_) handles.push_back(imu_->handle());
  return handles;
}

template <class Kind>
void BasicRobotInbox<Kind>::HoldScans() {
  // Who comes back may have been mounted anew. What a publisher that is gone sent last was not.
  const bool has_publisher = std::ranges::any_of(
      scans_, [](const ScanTopic& topic) { return topic.reader.writer_count() > 0; });
  if (!std::exchange(has_publisher_, has_publisher) && has_publisher_) mountings_.clear();
  const auto held = static_cast<std::ptrdiff_t>(unplaced_.size());
  for (const ScanTopic& topic : scans_) {
    TakeAllFrom(topic.reader, [&](const typename OnWire<Kind>::Scan& sample, const Guid& source) {
      HoldScan(topic, sample, source);
    });
  }
  if (scans_.size() < 2 || std::ssize(unplaced_) <= held) return;
  std::stable_sort(
      unplaced_.begin() + held, unplaced_.end(), [](const UnplacedScan& a, const UnplacedScan& b) {
        return a.scan.stamp < b.scan.stamp;
      });
}

template <class Kind>
void BasicRobotInbox<Kind>::Deliver(const BasicStaticTransforms<Kind>& transforms,
                                    team::RobotListener<Kind>& listener) {
  listener.ExpectOdometry(names_.name(), odometry_.writer_count() > 0);
  HearOdometry(listener);
  if constexpr (OnWire<Kind>::kUsesImu) {
    imu_->Deliver(
        [&](const std::string& frame) {
          return transforms.FindRotation(robot_frame_, frame, Own());
        },
        listener);
  }
  initial_poses_.TakeAll(
      [&](const wire::PoseWithCovarianceStamped& sample) { TakeInitialPose(sample, listener); });
  DeliverPlacedScans(transforms, listener);
}

template <class Kind>
void BasicRobotInbox<Kind>::HearOdometry(team::RobotListener<Kind>& listener) {
  TakeAllFrom(odometry_, [&](const wire::Odometry& sample, const Guid& source) {
    if (odometry_sources_.Note(source)) {
      refusals_.Tell(SeveralPublish(names_.Topic(kOdometryTopic)));
    }
    TakeOdometry(sample, listener);
  });
}

template <class Kind>
void BasicRobotInbox<Kind>::TakeOdometry(const wire::Odometry& sample,
                                         team::RobotListener<Kind>& listener) {
  const std::string_view objection = ObjectionToPose<Kind>(sample.header, sample.pose.pose);
  if (!objection.empty()) return refusals_.Add(names_.Topic(kOdometryTopic), objection);
  TellOfFrame(sample.header.frame_id);
  const std::size_t length = strnlen(sample.child_frame_id, kMaxNameLength + 1);
  if (length > 0 && length <= kMaxNameLength) robot_frame_ = sample.child_frame_id;
  listener.TakeOdometry(
      names_.name(), *FromWire(sample.header.stamp), OnWire<Kind>::PoseOf(sample.pose.pose));
}

// The service tells where the frame `odom` of the robot lies: that is to be the one the odometry is
// in, or transforms do not hang together.
template <class Kind>
void BasicRobotInbox<Kind>::TellOfFrame(std::string_view odometry_frame) {
  const std::string expected = names_.Frame(kOdometryFrame);
  if (odometry_frame == expected || std::exchange(is_frame_told_, true)) return;
  refusals_.Tell(names_.Topic(kOdometryTopic) + ": its frame_id is '" +
                 std::string(odometry_frame.substr(0, kMaxNameLength)) + "', not '" + expected +
                 "', of which " + kTransformsTopic +
                 " tells where it lies in the map: there is no way between the two");
}

/// @param source all zeros where it is not asked for.
template <class Kind>
void BasicRobotInbox<Kind>::HoldScan(const ScanTopic& topic,
                                     const typename OnWire<Kind>::Scan& sample,
                                     const Guid& source) {
  const std::string_view objection = ObjectionTo(sample);
  if (!objection.empty()) return refusals_.Add(topic.name, objection);
  if (source != Guid{}) {
    const std::string scans = topic.name + " in the frame '" + sample.header.frame_id + "'";
    if (scan_sources_.size() >= kMaxFrames) scan_sources_.clear();
    if (scan_sources_[scans].Note(source)) refusals_.Tell(SeveralPublish(scans));
  }
  unplaced_.push_back({.scan = OnWire<Kind>::ScanOf(sample),
                       .sensor_frame = sample.header.frame_id,
                       .topic = &topic.name});
}

// Scans and /tf_static overtake each other at the beginning. Scans of one frame wait for it, not
// those of another: anybody may send scans of frames that there are not.
template <class Kind>
void BasicRobotInbox<Kind>::DeliverPlacedScans(const BasicStaticTransforms<Kind>& transforms,
                                               team::RobotListener<Kind>& listener) {
  std::deque<UnplacedScan> waiting;
  std::vector<std::pair<UnplacedScan, Placement>> placed;
  std::size_t waited = 0;
  for (UnplacedScan& next : unplaced_) {
    if (const auto placement = SensorOnRobot(next.sensor_frame, transforms)) {
      waited += next.has_waited ? 1 : 0;
      placed.emplace_back(std::move(next), *placement);
    } else {
      next.has_waited = true;
      waiting.push_back(std::move(next));
    }
  }
  if (waited > 0) listener.ExpectWaited(names_.name(), waited);
  for (auto& [next, placement] : placed) {
    if constexpr (OnWire<Kind>::kUsesImu) {
      next.scan.height_m = HeightOf_m(next.sensor_frame, transforms);
    }
    DeliverScan(std::move(next), placement, listener);
  }
  unplaced_ = std::move(waiting);
  while (unplaced_.size() > kMaxUnplaced) LeaveOutOldest();
}

template <class Kind>
void BasicRobotInbox<Kind>::LeaveOutOldest() {
  refusals_.Add(*unplaced_.front().topic,
                "/tf_static does not say yet where on the robot its frame is");
  unplaced_.pop_front();
}

// A robot does not mount its sensors anew while it drives. Whether it did, its scans will tell.
template <class Kind>
void BasicRobotInbox<Kind>::DeliverScan(UnplacedScan unplaced,
                                        const Placement& placement,
                                        team::RobotListener<Kind>& listener) {
  const Placement used = PlacementInUse(unplaced.sensor_frame, placement);
  if (used.is_tilted) {
    return refusals_.Add(*unplaced.topic,
                         "its laser is tilted by more than 2.6 degrees, says " +
                             std::string(kStaticTransformsTopic));
  }
  if (!used.is_told) TellOfUnplaced(unplaced);
  typename Kind::Scan& scan = unplaced.scan;
  OnWire<Kind>::Mounting(scan) = used.T_robot_sensor;
  if constexpr (OnWire<Kind>::kUsesImu) {
    if (used.is_upside_down) OnWire<Kind>::TurnOver(scan);
  }
  const typename Kind::Pose& told = (placement.is_tilted ? used : placement).T_robot_sensor;
  if (Kind::IsSame(used.T_robot_sensor, told)) {
    listener.TakeScan(names_.name(), std::move(scan));
  } else {
    listener.TakeContestedScan(names_.name(), std::move(scan), told);
  }
}

/// The place that counts for a scan of a sensor that is said to sit there. Whether it was moved is
/// put to a trial, whether it was turned over or tilted is not.
template <class Kind>
typename BasicRobotInbox<Kind>::Placement BasicRobotInbox<Kind>::PlacementInUse(
    const std::string& sensor_frame, const Placement& placement) {
  if (placement.is_told && !placement.is_tilted && mountings_.size() < kMaxFrames) {
    mountings_.try_emplace(sensor_frame, placement);
  }
  const auto used = mountings_.find(sensor_frame);
  return used == mountings_.end() ? placement : used->second;
}

template <class Kind>
void BasicRobotInbox<Kind>::TellOfUnplaced(const UnplacedScan& unplaced) {
  if (unplaced_frames_.size() >= kMostUnplacedTold) return;
  if (!unplaced_frames_.insert(unplaced.sensor_frame).second) return;
  refusals_.Tell(*unplaced.topic + ": " + kStaticTransformsTopic + " does not say where '" +
                 unplaced.sensor_frame + "' sits on '" + robot_frame_ +
                 "': taken as in its middle, looking forward");
}

template <class Kind>
void BasicRobotInbox<Kind>::TakeInitialPose(const wire::PoseWithCovarianceStamped& sample,
                                            team::RobotListener<Kind>& listener) {
  const typename Kind::UncertainPose map_robot{
      .T_a_b = OnWire<Kind>::PoseOf(sample.pose.pose),
      .covariance = OnWire<Kind>::CovarianceOf(sample.pose.covariance)};
  std::string objection(ObjectionToPose<Kind>(sample.header, sample.pose.pose));
  if (objection.empty()) objection = ObjectionTo(map_robot);
  if (objection.empty()) objection = ObjectionToFrame(sample.header.frame_id);
  if (!objection.empty()) return refusals_.Add(names_.Topic(kInitialPoseTopic), objection);
  listener.PlaceAt(names_.name(), map_robot);
}

// One frame is named: anybody may tell of any number of them.
template <class Kind>
std::string BasicRobotInbox<Kind>::ObjectionToFrame(std::string_view frame) {
  if (frame.empty() || frame == kMapFrame) return {};
  if (foreign_frame_.empty()) foreign_frame_ = frame.substr(0, kMaxNameLength);
  const std::string named = frame == foreign_frame_ ? "'" + foreign_frame_ + "'" : "another";
  return "its frame_id is " + named + ", not '" + kMapFrame +
         "'; in RViz, that is the Fixed Frame of the Global Options";
}

/// A sensor nobody says anything about sits in the middle of the robot.
template <class Kind>
std::optional<typename BasicRobotInbox<Kind>::Placement> BasicRobotInbox<Kind>::SensorOnRobot(
    const std::string& sensor_frame, const BasicStaticTransforms<Kind>& transforms) {
  const auto known = FindSensor(sensor_frame, transforms);
  const bool is_settled =
      known && (mountings_.contains(sensor_frame) || !transforms.IsAwaited(sensor_frame, Own()));
  if (is_settled) return known;
  const auto now = std::chrono::steady_clock::now();
  if (missing_since_.size() >= kMaxFrames) missing_since_.clear();
  const auto since = missing_since_.try_emplace(sensor_frame, now).first->second;
  if (now - since < kPatienceForTransforms) return std::nullopt;
  return known.value_or(Placement{});
}

/// The participants that send the robot's scans, or its odometry.
template <class Kind>
std::set<Guid> BasicRobotInbox<Kind>::Own() const {
  std::set<Guid> own = odometry_.Participants();
  for (const ScanTopic& topic : scans_) own.merge(topic.reader.Participants());
  return own;
}

/// Where several tell of a frame, the robot's own participant is the one that knows.
template <class Kind>
std::optional<typename BasicRobotInbox<Kind>::Placement> BasicRobotInbox<Kind>::FindSensor(
    const std::string& sensor_frame, const BasicStaticTransforms<Kind>& transforms) {
  const std::set<Guid> own = transforms.has_rivals() ? Own() : std::set<Guid>{};
  const auto rotation = transforms.FindRotation(robot_frame_, sensor_frame, own);
  if (!rotation) return std::nullopt;
  const auto known = transforms.Find(robot_frame_, sensor_frame, own);
  if (transforms.has_rivals()) {
    const auto by_last = transforms.Find(robot_frame_, sensor_frame);
    const bool is_overruled = known && by_last && !Kind::IsSame(*known, *by_last);
    if (is_overruled && overruled_.insert(sensor_frame).second) {
      refusals_.Add(kStaticTransformsTopic,
                    "the robot itself says otherwise where its sensor sits");
    }
  }
  return Placement{.T_robot_sensor = known.value_or(typename Kind::Pose{}),
                   .is_told = true,
                   .is_upside_down = UprightnessOf(*rotation) < 0.0,
                   .is_tilted = !known};
}

/// Above the floor, where a frame lies on it, or else above the robot's; 0 where nobody tells.
template <class Kind>
double BasicRobotInbox<Kind>::HeightOf_m(const std::string& sensor_frame,
                                         const BasicStaticTransforms<Kind>& transforms) const {
  const std::set<Guid> own = transforms.has_rivals() ? Own() : std::set<Guid>{};
  auto height_m = transforms.FindHeight_m(names_.Frame(kFloorFrame), sensor_frame, own);
  if (!height_m) height_m = transforms.FindHeight_m(robot_frame_, sensor_frame, own);
  return std::max(0.0, height_m.value_or(0.0));
}

template class BasicRobotInbox<team::Planar>;
template class BasicRobotInbox<team::Spatial>;

}  // namespace qwsm::dds
