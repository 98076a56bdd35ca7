// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/entities/wait_set.hpp"

#include <dds/dds.h>

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
}

void WaitSet::Remove(Entity::Handle reader) { dds_waitset_detach(wait_set_.handle(), reader); }

bool WaitSet::Wait(std::chrono::nanoseconds timeout) {
  const dds_return_t triggered = dds_waitset_wait(wait_set_.handle(), nullptr, 0, timeout.count());
  bool was_rung = false;
  dds_take_guardcondition(bell_.handle(), &was_rung);
  return triggered > 0;
}

void WaitSet::Wake() { dds_set_guardcondition(bell_.handle(), true); }

}  // namespace qwsm::dds
