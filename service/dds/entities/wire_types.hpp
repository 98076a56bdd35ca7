// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "idl/diagnostic_msgs.h"
#include "idl/geometry_msgs.h"
#include "idl/nav_msgs.h"
#include "idl/qwsm_msgs.h"
#include "idl/rmw_dds_common.h"
#include "idl/sensor_msgs.h"
#include "idl/tf2_msgs.h"

/// The generated C types by their ROS names, and which descriptor belongs to each.
namespace qwsm::dds::wire {

using Time = builtin_interfaces_msg_dds__Time_;
using Header = std_msgs_msg_dds__Header_;
using LaserScan = sensor_msgs_msg_dds__LaserScan_;
using Imu = sensor_msgs_msg_dds__Imu_;
using PointCloud2 = sensor_msgs_msg_dds__PointCloud2_;
using Pose = geometry_msgs_msg_dds__Pose_;
using Vector3 = geometry_msgs_msg_dds__Vector3_;
using Quaternion = geometry_msgs_msg_dds__Quaternion_;
using PoseWithCovarianceStamped = geometry_msgs_msg_dds__PoseWithCovarianceStamped_;
using Twist = geometry_msgs_msg_dds__Twist_;
using TransformStamped = geometry_msgs_msg_dds__TransformStamped_;
using TFMessage = tf2_msgs_msg_dds__TFMessage_;
using Odometry = nav_msgs_msg_dds__Odometry_;
using Path = nav_msgs_msg_dds__Path_;
using PoseStamped = geometry_msgs_msg_dds__PoseStamped_;
using OccupancyGrid = nav_msgs_msg_dds__OccupancyGrid_;
using DiagnosticArray = diagnostic_msgs_msg_dds__DiagnosticArray_;
using DiagnosticStatus = diagnostic_msgs_msg_dds__DiagnosticStatus_;
using KeyValue = diagnostic_msgs_msg_dds__KeyValue_;
using MatchReport = qwsm_msgs_msg_dds__MatchReport_;
using RegistrationReport = qwsm_msgs_msg_dds__RegistrationReport_;
using RelevantScan = qwsm_msgs_msg_dds__RelevantScan_;
using MapEpoch = qwsm_msgs_msg_dds__MapEpoch_;
using MovedScan = qwsm_msgs_msg_dds__MovedScan_;
using MovedRobot = qwsm_msgs_msg_dds__MovedRobot_;
using Mark = qwsm_msgs_msg_dds__Mark_;
using Pose2D = qwsm_msgs_msg_dds__Pose2D_;
using ParticipantEntitiesInfo = rmw_dds_common_msg_dds__ParticipantEntitiesInfo_;
using HumbleParticipantEntitiesInfo = rmw_dds_common_msg_humble__ParticipantEntitiesInfo_;

/// The descriptor of a topic's type.
template <class T>
extern const dds_topic_descriptor_t* const kDescriptor;

template <>
inline const dds_topic_descriptor_t* const kDescriptor<LaserScan> =
    &sensor_msgs_msg_dds__LaserScan__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<Imu> = &sensor_msgs_msg_dds__Imu__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<PointCloud2> =
    &sensor_msgs_msg_dds__PointCloud2__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<PoseWithCovarianceStamped> =
    &geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<Twist> = &geometry_msgs_msg_dds__Twist__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<TFMessage> =
    &tf2_msgs_msg_dds__TFMessage__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<Odometry> =
    &nav_msgs_msg_dds__Odometry__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<OccupancyGrid> =
    &nav_msgs_msg_dds__OccupancyGrid__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<DiagnosticArray> =
    &diagnostic_msgs_msg_dds__DiagnosticArray__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<MatchReport> =
    &qwsm_msgs_msg_dds__MatchReport__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<MapEpoch> =
    &qwsm_msgs_msg_dds__MapEpoch__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<Mark> = &qwsm_msgs_msg_dds__Mark__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<Path> = &nav_msgs_msg_dds__Path__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<RegistrationReport> =
    &qwsm_msgs_msg_dds__RegistrationReport__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<RelevantScan> =
    &qwsm_msgs_msg_dds__RelevantScan__desc;
template <>
inline const dds_topic_descriptor_t* const kDescriptor<ParticipantEntitiesInfo> =
    &rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc;

}  // namespace qwsm::dds::wire
