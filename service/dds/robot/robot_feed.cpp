// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/robot_feed.hpp"

#include "service/dds/entities/wait_set.hpp"
#include "service/dds/robot/mounting_reader.hpp"
#include "service/dds/robot/robot_inbox.hpp"

namespace qwsm::dds {

class RobotFeed::Topics {
 public:
  Topics(const Participant& participant,
         const RobotNames& names,
         const std::vector<std::string>& scan_topics,
         Refusals& refusals)
      : wait_set_(participant),
        mountings_(participant, refusals),
        inbox_(participant, names, refusals, scan_topics) {
    for (const Entity::Handle handle : inbox_.handles()) wait_set_.Add(handle);
  }

  void Deliver(std::chrono::nanoseconds timeout, team::RobotListener<team::Planar>& listener) {
    wait_set_.Wait(timeout);
    inbox_.HoldScans();
    mountings_.Take();
    inbox_.Deliver(mountings_.transforms(), listener);
  }

 private:
  WaitSet wait_set_;
  BasicMountingReader<team::Planar> mountings_;
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
