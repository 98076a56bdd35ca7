// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/entities/entity.hpp"

#include <dds/dds.h>

#include <utility>

namespace qwsm::dds {

Entity::Entity(Handle handle, const std::string& what) : handle_(handle) {
  if (handle < 0) throw DdsError("DDS: " + what + ": " + dds_strretcode(-handle));
}

Entity::Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}

Entity& Entity::operator=(Entity&& other) noexcept {
  std::swap(handle_, other.handle_);
  return *this;
}

Entity::~Entity() {
  if (handle_ > 0) dds_delete(handle_);
}

}  // namespace qwsm::dds
