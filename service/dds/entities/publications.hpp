// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "service/dds/entities/participant.hpp"

namespace qwsm::dds {

/// A writer somewhere in the domain, this participant's included, that has come, has changed or has
/// gone. What it refers to lives as long as the call.
struct Publication {
  Guid writer{};
  bool is_alive = false;
  // These are known only of a writer that is alive.
  Guid participant{};
  std::string_view topic{};  ///< The topic's name as DDS has it.
  std::string_view type{};
  std::string_view user_data{};
  bool is_reliable = false;
  bool is_latched = false;  ///< What was written is kept for readers that come later.
};

/// Finds out who publishes what in the domain.
class Publications {
 public:
  explicit Publications(const Participant& participant);

  /// Calls `take` with every publication that has changed since the last call; returns how many
  /// there were.
  std::size_t TakeAll(const std::function<void(const Publication&)>& take) const;
  Entity::Handle handle() const { return reader_.handle(); }

 private:
  Entity reader_;
};

}  // namespace qwsm::dds
