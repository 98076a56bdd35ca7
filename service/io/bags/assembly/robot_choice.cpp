// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/assembly/robot_choice.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace qwsm::io {
namespace {

constexpr double kLevel = 0.999;  // Cosine of 2.6 degrees.

std::string ListOf(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

template <class Value>
std::vector<std::string> KeysOf(const std::map<std::string, Value>& map) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : map) keys.push_back(key);
  return keys;
}

std::string AsTopic(const std::string& name) { return name.starts_with('/') ? name : "/" + name; }

bool IsWithin(const std::string& topic, const std::string& name_space) {
  return topic.starts_with(name_space + "/");
}

/// The namespace that two have in common: "/robot1" of "/robot1/front" and "/robot1/rear".
std::string CommonNamespace(const std::string& a, const std::string& b) {
  std::string common = a;
  while (!common.empty() && common != b && !IsWithin(b, common)) common = NamespaceOf(common);
  return common;
}

/// The namespaces of robots that tell their odometry on a /tf that all share: their lasers are on
/// frames that move by themselves. None where there is but one such frame.
std::set<std::string> NamespacesOnSharedTransforms(const BagContents& contents) {
  const auto shared = contents.transforms.find("");
  if (shared == contents.transforms.end()) return {};
  std::map<std::string, std::string> by_robot_frame;
  for (const auto& [topic, scans] : contents.scans) {
    const std::optional<std::string> frame = shared->second.RobotFrameOf(scans.frame);
    if (!frame) continue;
    const std::string own = NamespaceOf(topic);
    const auto [known, is_new] = by_robot_frame.try_emplace(*frame, own);
    if (!is_new) known->second = CommonNamespace(known->second, own);
  }
  std::set<std::string> namespaces;
  for (const auto& [frame, name_space] : by_robot_frame) namespaces.insert(name_space);
  namespaces.erase("");
  return by_robot_frame.size() < 2 ? std::set<std::string>{} : namespaces;
}

class Chooser {
 public:
  Chooser(BagContents& contents, const LogOptions& options, LogReport& report, BagFaults& faults)
      : contents_(contents), options_(options), report_(report), faults_(faults) {}

  RobotChoice Choose() {
    const std::vector<std::string> topics = ChooseScans();
    RobotChoice choice;
    if (topics.empty()) return choice;
    const std::string robot_frame = ChooseOdometry(topics.front(), choice.odometry);
    choice.lasers = MountAll(topics, robot_frame);
    ChooseImu(robot_frame, choice.imu);
    for (auto& [topic, track] : contents_.truth) {
      if (RobotOf(topic) == robot_) choice.truth = std::move(track);
    }
    return choice;
  }

 private:
  [[noreturn]] void Refuse(const std::string& what) const {
    throw LogError(report_.name + ": " + what);
  }

  /// @param by_robot topics of scans by namespace.
  [[noreturn]] void RefuseSeveral(
      const std::map<std::string, std::vector<std::string>>& by_robot) const {
    std::vector<std::pair<std::size_t, std::string>> robots;
    for (const auto& [name_space, topics] : by_robot) {
      if (name_space.empty()) continue;  // Scans of nobody's namespace.
      std::size_t scans = 0;
      for (const std::string& topic : topics) scans += contents_.scans[topic].places.size();
      robots.emplace_back(scans, name_space.substr(1));
    }
    std::ranges::stable_sort(robots, std::greater(), &std::pair<std::size_t, std::string>::first);
    std::vector<std::string> names;
    for (const auto& [scans, name] : robots) names.push_back(name);
    throw SeveralRobotsError(report_.name + ": holds several robots: " + ListOf(KeysOf(by_robot)) +
                                 "; choose one with --robot",
                             std::move(names));
  }

  /// Namespaces that have odometry of their own.
  std::set<std::string> RobotNamespaces() const {
    std::set<std::string> robots = NamespacesOnSharedTransforms(contents_);
    for (const auto& [topic, odometry] : contents_.odometry) robots.insert(NamespaceOf(topic));
    for (const auto& [name_space, tree] : contents_.transforms) {
      if (!name_space.empty()) robots.insert(name_space);
    }
    std::erase_if(robots, [this](const std::string& robot) {  // Such as /wheels/odom.
      return std::ranges::none_of(contents_.scans,
                                  [&](const auto& scans) { return IsWithin(scans.first, robot); });
    });
    return robots;
  }

  /// The robot a topic belongs to: the longest namespace of those that are robots.
  std::string RobotOf(const std::string& topic) const {
    std::string robot;
    if (robots_.size() < 2) return robot;
    for (const std::string& candidate : robots_) {
      if (IsWithin(topic, candidate) && candidate.size() > robot.size()) robot = candidate;
    }
    return robot;
  }

  std::vector<std::string> ChooseScans() {
    robots_ = RobotNamespaces();
    std::vector<std::string> topics = WantedScans();
    std::map<std::string, std::vector<std::string>> by_robot;
    for (const std::string& topic : topics) by_robot[RobotOf(topic)].push_back(topic);
    if (by_robot.size() > 1) {
      if (options_.robot.empty()) RefuseSeveral(by_robot);
      robot_ = AsTopic(options_.robot);
      if (!by_robot.contains(robot_)) {
        Refuse("has no scans of a robot '" + options_.robot + "'; it has " +
               ListOf(KeysOf(by_robot)));
      }
    } else if (!by_robot.empty()) {
      robot_ = by_robot.begin()->first;
      if (!options_.robot.empty()) KeepScansOfWanted(by_robot[robot_]);
    }
    topics = by_robot[robot_];
    return options_.scan_topics.empty() ? OneTopicPerLaser(topics) : topics;
  }

  /// Of the topics of the only robot, keeps those of the one that is asked for; all of a robot that
  /// has no namespace.
  void KeepScansOfWanted(std::vector<std::string>& topics) const {
    std::vector<std::string> wanted;
    for (const std::string& topic : topics) {
      if (IsWithin(topic, AsTopic(options_.robot))) wanted.push_back(topic);
    }
    const bool has_namespace = robots_.size() == 1 && !robots_.begin()->empty();
    if (wanted.empty() && !has_namespace) return;
    if (wanted.empty()) {
      Refuse("has no scans of a robot '" + options_.robot + "'; it has those of " +
             ListOf({robots_.begin(), robots_.end()}));
    }
    topics = std::move(wanted);
  }

  std::vector<std::string> WantedScans() const {
    if (options_.scan_topics.empty()) return KeysOf(contents_.scans);
    std::vector<std::string> topics;
    for (const std::string& name : options_.scan_topics) {
      const std::size_t before = topics.size();
      for (const auto& [topic, scans] : contents_.scans) {
        const bool is_on_it = topic == AsTopic(name) || topic.starts_with(AsTopic(name) + "[");
        if (is_on_it) topics.push_back(topic);
      }
      if (topics.size() > before) continue;
      Refuse("has no scans on '" + AsTopic(name) + "'; it has them on " +
             ListOf(KeysOf(contents_.scans)));
    }
    return topics;
  }

  std::vector<std::string> OneTopicPerLaser(const std::vector<std::string>& topics) {
    std::map<std::string, std::string> by_frame;
    for (const std::string& topic : topics) {
      const auto [known, is_new] = by_frame.try_emplace(contents_.scans[topic].frame, topic);
      if (is_new) continue;
      const bool is_better =
          contents_.scans[topic].places.size() > contents_.scans[known->second].places.size();
      const std::string other = is_better ? std::exchange(known->second, topic) : topic;
      faults_.Doubt(known->second + " and " + other + " are of one laser, '" + known->first +
                    "': the first is read; choose with --scan");
    }
    std::vector<std::string> chosen;
    for (const auto& [frame, topic] : by_frame) chosen.push_back(topic);
    std::ranges::sort(chosen);
    return chosen;
  }

  /// The transforms of the robot: its own, or those that all share.
  TransformTree& Transforms() {
    const bool is_only_one = robots_.size() == 1;
    TransformTree& own = contents_.transforms[is_only_one ? *robots_.begin() : robot_];
    return own.empty() ? contents_.transforms[""] : own;
  }

  /// Chooses where odometry comes from. @return the frame whose pose it is; empty if unknown.
  std::string ChooseOdometry(const std::string& scan_topic, OdometryTrack& track) {
    const std::string topic = OdometryTopicOf(scan_topic);
    TransformTree& tree = Transforms();
    const std::string& laser_frame = contents_.scans[scan_topic].frame;
    const std::optional<std::string> robot_frame = tree.RobotFrameOf(laser_frame);
    if (!topic.empty()) {
      report_.notes.push_back("odometry from " + topic);
      OdometryTopic& odometry = contents_.odometry[topic];
      track = std::move(odometry.track);
      if (!odometry.child_frame.empty()) return odometry.child_frame;
      return robot_frame ? *robot_frame : TopmostFrameOf(laser_frame);
    }
    if (!robot_frame) {
      faults_.Doubt("has neither odometry nor /tf of a robot that moves: scans are matched alone");
      return TopmostFrameOf(laser_frame);
    }
    const TransformTree::Link* link = tree.LinkOf(*robot_frame);
    report_.notes.push_back("odometry from /tf, of " + *robot_frame + " in " + link->parent);
    track = link->track;
    track.Sort();
    return *robot_frame;
  }

  /// The frame that all others of a laser sit on; empty where nothing says where it sits.
  std::string TopmostFrameOf(const std::string& laser_frame) {
    const std::vector<std::string> ancestry = Transforms().AncestryOf(laser_frame);
    return ancestry.size() > 1 ? ancestry.back() : "";
  }

  /// The topic of odometry; empty where it has to come from /tf.
  std::string OdometryTopicOf(const std::string& scan_topic) {
    const std::string& wanted = options_.odometry_topic;
    if (!wanted.empty() && (AsTopic(wanted) == "/tf" || AsTopic(wanted) == robot_ + "/tf"))
      return "";
    if (!wanted.empty()) {
      if (contents_.odometry.contains(AsTopic(wanted))) return AsTopic(wanted);
      Refuse("has no odometry on '" + AsTopic(wanted) + "'; it has it on " +
             ListOf(KeysOf(contents_.odometry)) + ", and maybe on /tf");
    }
    std::vector<std::string> topics;
    for (const auto& [topic, odometry] : contents_.odometry) {
      if (RobotOf(topic) == RobotOf(scan_topic)) topics.push_back(topic);
    }
    if (topics.empty()) return "";
    const auto rank = [&](const std::string& topic) {
      const OdometryTopic& odometry = contents_.odometry[topic];
      const bool is_of_laser =
          Transforms().Find(odometry.child_frame, contents_.scans[scan_topic].frame).has_value();
      const bool is_robots =
          topic == robot_ + "/odom" || topic == NamespaceOf(scan_topic) + "/odom";
      return std::tuple(is_of_laser, is_robots, topic.ends_with("/odom"), odometry.track.size());
    };
    const std::string best = *std::ranges::max_element(topics, {}, rank);
    if (topics.size() > 1) {
      faults_.Doubt("odometry is taken from " + best + " of " + ListOf(topics) +
                    "; choose with --odom");
    }
    return best;
  }

  /// The robot's inertial sensor, of several topics that with the most messages: /imu/data and
  /// /imu/data_raw are one sensor.
  void ChooseImu(const std::string& robot_frame, std::vector<ImuReading>& readings) {
    std::string best;
    for (const auto& [topic, imu] : contents_.imus) {
      if (RobotOf(topic) != robot_) continue;
      if (best.empty() || imu.readings.size() > contents_.imus[best].readings.size()) best = topic;
    }
    if (best.empty()) return;
    const std::string& frame = contents_.imus[best].frame;
    const std::optional<Transform3> T_robot_imu = Transforms().Find(robot_frame, frame);
    report_.notes.push_back("turns from the gyro of " + best + ", of '" + frame + "'" +
                            (T_robot_imu ? "" : ", taken as upright on the robot"));
    readings = std::move(contents_.imus[best].readings);
    const Quaternion rotation = T_robot_imu.value_or(Transform3{}).rotation;
    for (ImuReading& reading : readings) reading = OnRobot(reading, rotation);
    std::ranges::stable_sort(readings, {}, &ImuReading::stamp);
  }

  /// The lasers as they sit; of several that nobody asked for, those that fit a level map.
  std::vector<LaserChoice> MountAll(const std::vector<std::string>& topics,
                                    const std::string& robot_frame) {
    std::vector<LaserChoice> lasers;
    for (const std::string& topic : topics) lasers.push_back(Mount(topic, robot_frame));
    const auto fits = [](const LaserChoice& laser) { return laser.is_placed && laser.is_level; };
    if (options_.scan_topics.empty() && std::ranges::any_of(lasers, fits)) {
      std::erase_if(lasers, [&](const LaserChoice& laser) {
        if (fits(laser)) return false;
        faults_.Doubt(laser.topic + " is left out for that; choose it with --scan");
        return true;
      });
    }
    if (options_.scan_topics.empty()) {  // The one that looks ahead is the front one.
      std::ranges::stable_sort(lasers, {}, [](const LaserChoice& laser) {
        return std::abs(laser.T_robot_laser.theta_rad);
      });
    }
    for (std::size_t i = 0; i < lasers.size(); ++i) {
      lasers[i].name = i == 0 ? "front" : i == 1 ? "rear" : "laser" + std::to_string(i + 1);
      report_.notes.push_back("scans from " + lasers[i].topic + ", of '" +
                              contents_.scans[lasers[i].topic].frame + "'" +
                              (lasers[i].is_upside_down ? ", which is upside down" : ""));
    }
    return lasers;
  }

  LaserChoice Mount(const std::string& topic, const std::string& robot_frame) {
    const std::string& frame = contents_.scans[topic].frame;
    LaserChoice laser{.topic = topic, .name = {}, .T_robot_laser = {}};
    const std::optional<Transform3> T_robot_laser = Transforms().Find(robot_frame, frame);
    if (!T_robot_laser && !robot_frame.empty()) {
      faults_.Doubt("nothing says where the laser '" + frame + "' of " + topic + " sits on '" +
                    robot_frame + "': taken as in its middle, looking forward");
    }
    laser.is_placed = T_robot_laser.has_value();
    if (T_robot_laser) {
      const double uprightness = UprightnessOf(T_robot_laser->rotation);
      laser.T_robot_laser = Planar(*T_robot_laser);
      // Where there is a frame on the floor, that is what counts.
      const auto T_floor_laser = Transforms().Find("base_footprint", frame);
      laser.height_m = std::max(0.0, T_floor_laser.value_or(*T_robot_laser).z_m);
      laser.is_upside_down = uprightness < 0.0;
      laser.is_level = std::abs(uprightness) > kLevel;
      if (!laser.is_level) TellTilt(topic, uprightness);
    }
    return laser;
  }

  void TellTilt(const std::string& topic, double uprightness) {
    const double tilt_deg =
        std::acos(std::min(1.0, std::abs(uprightness))) * 180.0 / std::numbers::pi;
    faults_.Doubt("the laser of " + topic + " is tilted by " +
                  std::to_string(std::lround(tilt_deg)) +
                  " degrees: its ranges are taken as level");
  }

  BagContents& contents_;
  const LogOptions& options_;
  LogReport& report_;
  BagFaults& faults_;
  std::set<std::string> robots_;
  std::string robot_;  // Its namespace.
};

}  // namespace

RobotChoice ChooseRobot(BagContents& contents,
                        const LogOptions& options,
                        LogReport& report,
                        BagFaults& faults) {
  return Chooser(contents, options, report, faults).Choose();
}

}  // namespace qwsm::io
