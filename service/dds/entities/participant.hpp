// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "service/dds/entities/entity.hpp"
#include "service/dds/entities/network_options.hpp"

namespace qwsm::dds {

/// Identifies an entity on the network.
using Guid = std::array<std::uint8_t, 16>;

/// This program's membership in a DDS domain; all topics, readers and writers are made from it.
///
/// Configured by CYCLONEDDS_URI as any program with Cyclone DDS, then by the options, which win.
class Participant {
 public:
  /// Joins the domain. @throws DdsError where the network cannot be used as told.
  explicit Participant(const NetworkOptions& options);

  Entity::Handle handle() const { return participant_.handle(); }
  Guid guid() const;

 private:
  Entity domain_;
  Entity participant_;
};

/// The GUID of an entity on the network.
Guid GuidOf(Entity::Handle entity);

}  // namespace qwsm::dds
