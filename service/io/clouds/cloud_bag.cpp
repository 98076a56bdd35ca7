// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/cloud_bag.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "service/io/bags/assembly/bag_survey.hpp"
#include "service/io/bags/messages/point_cloud_message.hpp"

namespace slam6d::io {
namespace {

using namespace qwsm::io;

std::string AsTopic(const std::string& name) { return name.starts_with('/') ? name : "/" + name; }

template <class Value>
std::string ListOfKeys(const std::map<std::string, Value>& map) {
  std::string list;
  for (const auto& [key, value] : map) list += (list.empty() ? "" : ", ") + key;
  return list.empty() ? "none" : list;
}

bool IsWithin(const std::string& topic, const std::string& name_space) {
  return topic.starts_with(name_space + "/");
}

PointCloud CloudOf(const PointCloudMessage& message) {
  PointCloud cloud;
  cloud.reserve(message.points_m.size());
  for (const auto& [x_m, y_m, z_m] : message.points_m) cloud.push_back({x_m, y_m, z_m});
  return cloud;
}

CloudContents SurveyOrThrow(const std::filesystem::path& path,
                            LogReport& report,
                            BagFaults& faults) {
  try {
    return SurveyClouds(path, report, faults);
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    throw std::runtime_error(what.starts_with(report.name) ? what : report.name + ": " + what);
  }
}

}  // namespace

CloudBag::CloudBag(const std::filesystem::path& path, const CloudBagOptions& options, Tell tell)
    : faults_(report_, options_) {
  report_.name = path.string();
  options_.on_fault = std::move(tell);
  contents_ = SurveyOrThrow(path, report_, faults_);
  topic_ = CloudTopicOf(options.points);
  CloudTopic& clouds = contents_.clouds[topic_];
  frame_ = clouds.frame;
  report_.notes.push_back("clouds from " + topic_ + ", of '" + frame_ + "'");
  const auto every = static_cast<std::size_t>(std::max(1, options.every));
  for (std::size_t i = 0; i < clouds.places.size(); i += every) {
    places_.push_back(clouds.places[i]);
  }
  ChooseOdometry(options.odometry);
  contents_.clouds.clear();
  contents_.odometry.clear();
  contents_.tracks.clear();
}

void CloudBag::Refuse(const std::string& what) const {
  throw std::runtime_error(report_.name + ": " + what);
}

/// That which is asked for, or that with the most clouds.
std::string CloudBag::CloudTopicOf(const std::string& wanted) {
  const auto& clouds = contents_.clouds;
  if (!wanted.empty()) {
    if (clouds.contains(AsTopic(wanted))) return AsTopic(wanted);
    Refuse("has no clouds (sensor_msgs/PointCloud2) on '" + AsTopic(wanted) + "'; it has them on " +
           ListOfKeys(clouds));
  }
  if (clouds.empty()) Refuse("has no clouds (sensor_msgs/PointCloud2)");
  const auto most = std::ranges::max_element(
      clouds, {}, [](const auto& topic) { return topic.second.places.size(); });
  if (clouds.size() > 1) {
    faults_.Doubt("has clouds on " + ListOfKeys(clouds) + ": " + most->first +
                  " is read; choose with --points");
  }
  return most->first;
}

/// That which is asked for; else that of the longest namespace in which the clouds are, /odom
/// before others. Empty where it has to come from /tf.
std::string CloudBag::OdometryTopicOf(const std::string& wanted) {
  if (!wanted.empty()) {
    if (AsTopic(wanted).ends_with("/tf")) return "";
    if (contents_.odometry.contains(AsTopic(wanted))) return AsTopic(wanted);
    Refuse("has no odometry on '" + AsTopic(wanted) + "'; it has it on " +
           ListOfKeys(contents_.odometry) + ", and maybe on /tf");
  }
  std::map<std::string, OdometryTopic3*> near;
  for (auto& [topic, odometry] : contents_.odometry) {
    if (IsWithin(topic_, NamespaceOf(topic))) near.emplace(topic, &odometry);
  }
  if (near.empty()) return "";
  const auto best = std::ranges::max_element(near, {}, [](const auto& candidate) {
    const std::string& topic = candidate.first;
    return std::tuple(
        NamespaceOf(topic).size(), topic.ends_with("/odom"), candidate.second->track.size());
  });
  if (near.size() > 1) {
    faults_.Doubt("odometry is taken from " + best->first + " of " + ListOfKeys(near) +
                  "; choose with --odom");
  }
  return best->first;
}

void CloudBag::ChooseOdometry(const std::string& wanted) {
  std::string name_space;  // Whose transforms are the robot's own, or else those that all share.
  for (const auto& [candidate, tree] : contents_.transforms) {
    if (IsWithin(topic_, candidate) && candidate.size() > name_space.size()) name_space = candidate;
  }
  const TransformTree& tree = contents_.transforms[name_space];
  const std::string topic = OdometryTopicOf(wanted);
  if (topic.empty()) return TakeTransforms(tree, name_space);
  report_.notes.push_back("odometry from " + topic);
  odometry_ = std::move(contents_.odometry[topic].track);
  MountOn(contents_.odometry[topic].child_frame, tree);
}

/// Takes the odometry that /tf tells, if it does.
void CloudBag::TakeTransforms(const TransformTree& tree, const std::string& name_space) {
  const std::optional<std::string> robot_frame = tree.RobotFrameOf(frame_);
  if (!robot_frame) {
    faults_.Doubt(
        "has neither odometry nor /tf of a robot that moves: a cloud starts where the "
        "motion before it leads");
    return;
  }
  report_.notes.push_back("odometry from /tf, of " + *robot_frame + " in " +
                          tree.LinkOf(*robot_frame)->parent);
  odometry_ = std::move(contents_.tracks[name_space][*robot_frame]);
  MountOn(*robot_frame, tree);
}

void CloudBag::MountOn(const std::string& robot_frame, const TransformTree& tree) {
  const std::optional<Transform3> T_robot_sensor = tree.Find(robot_frame, frame_);
  if (T_robot_sensor) {
    T_robot_sensor_ = PoseOf(*T_robot_sensor);
  } else if (robot_frame != frame_) {
    faults_.Doubt("nothing says where the sensor '" + frame_ + "' of " + topic_ + " sits on '" +
                  robot_frame + "': taken as in its middle, looking forward");
  }
}

CloudBag::Cloud CloudBag::Read(std::size_t number) {
  const MessagePlace& place = places_[number];
  MessageSource& messages = contents_.files[place.file].messages();
  const Encoding encoding = messages.topics()[place.topic].encoding;
  Cloud cloud{.stamp = place.stamp, .points = {}, .T_odom_sensor = {}};
  if (odometry_) {
    const std::optional<Pose3> T_odom_robot = odometry_->At(place.stamp);
    if (T_odom_robot) cloud.T_odom_sensor = *T_odom_robot * T_robot_sensor_;
  }
  try {
    cloud.points =
        CloudOf(DecodePointCloud(PlainMessage(messages.Read(place.address), buffer_), encoding));
  } catch (const MessageError& error) {
    Refuse("message " + std::to_string(place.sequence) + " (" + topic_ + "): " + error.what());
  }
  return cloud;
}

}  // namespace slam6d::io
