// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/entities/wait_set.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace qwsm::dds {

WaitSet::WaitSet(const Participant& participant)
    : wait_set_(dds_create_waitset(participant.handle()), "wait set"),
      bell_(dds_create_guardcondition(participant.handle()), "guard condition") {
  Add(bell_.handle());
}

void WaitSet::Add(Entity::Handle reader) {
  if (dds_waitset_attach(wait_set_.handle(), reader, reader) != DDS_RETCODE_OK) {
    throw DdsError("DDS: a reader cannot be waited for");
  }
  woken_.emplace_back();
}

void WaitSet::Remove(Entity::Handle reader) {
  if (dds_waitset_detach(wait_set_.handle(), reader) == DDS_RETCODE_OK) woken_.pop_back();
}

std::vector<Entity::Handle> WaitSet::Wait(std::chrono::nanoseconds timeout) {
  const dds_return_t count =
      dds_waitset_wait(wait_set_.handle(), woken_.data(), woken_.size(), timeout.count());
  const auto filled = std::min(woken_.size(), static_cast<std::size_t>(std::max(count, 0)));
  bool was_rung = false;
  dds_take_guardcondition(bell_.handle(), &was_rung);
  std::vector<Entity::Handle> readers;
  for (const dds_attach_t handle : std::span(woken_).first(filled)) {
    if (handle != bell_.handle()) readers.push_back(static_cast<Entity::Handle>(handle));
  }
  return readers;
}

void WaitSet::Wake() { dds_set_guardcondition(bell_.handle(), true); }

}  // namespace qwsm::dds
