// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/imu_inbox.hpp"

#include "service/dds/wire/imu_conversion.hpp"

namespace qwsm::dds {
namespace {

// A transform that is not there after this long will not come.
constexpr auto kPatienceForMounting = std::chrono::seconds(1);
constexpr std::size_t kMostWaiting = 1024;

}  // namespace

ImuInbox::ImuInbox(const Participant& participant, const RobotNames& names, Refusals& refusals)
    : names_(names),
      refusals_(refusals),
      reader_(participant, names.Topic(kImuTopic), Profile::kFastSensorIn) {}

void ImuInbox::Take(const wire::Imu& sample) {
  const std::string_view objection = ObjectionTo(sample);
  if (!objection.empty()) return refusals_.Add(names_.Topic(kImuTopic), objection);
  waiting_.push_back({.reading = FromWire(sample), .frame = sample.header.frame_id});
  if (waiting_.size() > kMostWaiting) waiting_.pop_front();
}

void ImuInbox::Deliver(const FindRotation& find, team::RobotListener<team::Planar>& listener) {
  listener.ExpectImu(names_.name(), reader_.writer_count() > 0);
  reader_.TakeAll([this](const wire::Imu& sample) { Take(sample); });
  while (!waiting_.empty()) {
    const std::optional<Quaternion> robot_imu = find(waiting_.front().frame);
    if (!robot_imu && !takes_unmounted_) {
      const auto now = Clock::now();
      if (now - waits_since_.emplace(waits_since_.value_or(now)) < kPatienceForMounting) return;
      takes_unmounted_ = true;
      refusals_.Tell(names_.Topic(kImuTopic) + ": /tf_static does not say how '" +
                     waiting_.front().frame + "' is mounted: taken as upright on the robot");
    }
    listener.TakeImu(names_.name(),
                     OnRobot(waiting_.front().reading, robot_imu.value_or(Quaternion{})));
    waiting_.pop_front();
  }
}

}  // namespace qwsm::dds
