// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "service/dds/entities/wire_types.hpp"
#include "service/team/marks/mark.hpp"

namespace qwsm::dds {

/// The mark as it is published, see idl/qwsm_msgs/msg/Mark.msg. Points into both.
wire::Mark ToWire(const team::Mark& mark, const std::string& map_frame);
/// Says why a sample must not be converted; empty if it may.
std::string_view ObjectionTo(const wire::Mark& sample);
/// The mark of a sample. @pre ObjectionTo(sample).empty()
team::Mark FromWire(const wire::Mark& sample);

}  // namespace qwsm::dds
