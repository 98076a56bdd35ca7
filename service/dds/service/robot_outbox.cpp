// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/robot_outbox.hpp"

#include "service/dds/wire/report_conversion.hpp"

namespace qwsm::dds {

RobotOutbox::RobotOutbox(const Participant& participant,
                         const RobotNames& names,
                         const Writer<wire::TFMessage>& transforms,
                         const Claim& claim)
    : map_frame_(kMapFrame),
      poses_(participant, names, transforms),
      reports_(participant, names.Topic(kReportTopic), Profile::kAnswer, ToUserData(claim)) {}

void RobotOutbox::Publish(const team::RobotAnswer& answer) const {
  poses_.Publish(answer.step.stamp, answer.step.map_robot, answer.T_odom_robot);
}

void RobotOutbox::Report(const team::RobotAnswer& answer) const {
  const MatchReport report = ReportOf(answer);
  reports_.Write(ToWire(report, map_frame_));
}

}  // namespace qwsm::dds
