// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/robot_outbox.hpp"

#include "service/dds/wire/registration_report.hpp"
#include "service/dds/wire/report_conversion.hpp"
#include "service/team/scans/component.hpp"

namespace qwsm::dds {

template <class Kind>
RobotOutbox<Kind>::RobotOutbox(const Participant& participant,
                               const RobotNames& names,
                               const Writer<wire::TFMessage>& transforms,
                               const Claim& claim)
    : poses_(participant, names, transforms),
      reports_(participant,
               names.Topic(OnWire<Kind>::kReportTopic),
               Profile::kAnswer,
               ToUserData(claim)) {}

// A frame has one parent: where odometry that there is has a gap, `base_link` stays below `odom`,
// which stays where it was.
template <class Kind>
void RobotOutbox<Kind>::Publish(const team::Answer<Kind>& answer) const {
  const std::string map_frame = team::FrameOf(answer.component);
  const Timestamp stamp = answer.step.stamp;
  const auto& map_robot = answer.told ? *answer.told : answer.step.map_robot;
  poses_.Publish(map_frame, stamp, map_robot);
  if (answer.lacks_odometry) return;
  poses_.PublishTransform(map_frame, stamp, map_robot.T_a_b, answer.T_odom_robot);
}

template <class Kind>
void RobotOutbox<Kind>::Report(const team::Answer<Kind>& answer) const {
  const auto report = ReportOf(answer);
  const std::string map_frame = team::FrameOf(answer.component);
  reports_.Write(ToWire(report, map_frame));
}

template class RobotOutbox<team::Planar>;
template class RobotOutbox<team::Spatial>;

}  // namespace qwsm::dds
