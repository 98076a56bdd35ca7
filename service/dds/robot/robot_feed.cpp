// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/robot_feed.hpp"

#include "service/dds/entities/reader.hpp"
#include "service/dds/entities/wait_set.hpp"
#include "service/dds/robot/robot_inbox.hpp"
#include "service/dds/wire/static_transforms.hpp"

namespace qwsm::dds {

class RobotFeed::Topics {
 public:
  Topics(const Participant& participant,
         const RobotNames& names,
         const std::vector<std::string>& scan_topics,
         Refusals& refusals)
      : wait_set_(participant),
        static_transforms_(participant, kStaticTransformsTopic, Profile::kStaticTransforms),
        inbox_(participant, names, refusals, scan_topics) {
    for (const Entity::Handle handle : inbox_.handles()) wait_set_.Add(handle);
  }

  void Deliver(std::chrono::nanoseconds timeout, team::RobotListener<team::Planar>& listener) {
    wait_set_.Wait(timeout);
    inbox_.HoldScans();
    static_transforms_.TakeAllWithSource(
        [this](const wire::TFMessage& message, const Guid& source) {
          transforms_.Take(message, source);
        });
    inbox_.Deliver(transforms_, listener);
  }

 private:
  WaitSet wait_set_;
  Reader<wire::TFMessage> static_transforms_;
  StaticTransforms transforms_{[this] { return static_transforms_.Participants(); }};
  RobotInbox inbox_;
};

RobotFeed::RobotFeed(const Participant& participant,
                     const RobotNames& names,
                     const std::vector<std::string>& scan_topics,
                     Refusals& refusals)
    : topics_(std::make_unique<Topics>(participant, names, scan_topics, refusals)) {}

RobotFeed::~RobotFeed() = default;

void RobotFeed::Deliver(std::chrono::nanoseconds timeout,
                        team::RobotListener<team::Planar>& listener) {
  topics_->Deliver(timeout, listener);
}

}  // namespace qwsm::dds
