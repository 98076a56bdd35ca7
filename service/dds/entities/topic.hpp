// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/dds/entities/participant.hpp"
#include "service/dds/entities/wire_types.hpp"

namespace qwsm::dds {

/// Makes the DDS topic of a ROS topic: of `/robot1/scan` it is `rt/robot1/scan`.
/// @throws DdsError, also where the name has other characters than letters, digits, _ and /.
Entity MakeTopic(const Participant& participant,
                 const dds_topic_descriptor_t& descriptor,
                 const std::string& topic);

}  // namespace qwsm::dds
