// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace qwsm::dds {

/// Tells what Cyclone DDS refused to do. The text names the entity or topic and says how to mend
/// it.
class DdsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Owns an entity of Cyclone DDS, and with it all that was made from it.
class Entity {
 public:
  using Handle = std::int32_t;

  Entity() = default;
  /// Takes over what a dds_create... function returned.
  /// @param what names the entity in messages. @throws DdsError where the handle is an error code.
  Entity(Handle handle, const std::string& what);
  Entity(Entity&& other) noexcept;
  Entity& operator=(Entity&& other) noexcept;
  ~Entity();

  Handle handle() const { return handle_; }

 private:
  Handle handle_ = 0;
};

}  // namespace qwsm::dds
