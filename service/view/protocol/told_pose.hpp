// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "service/dds/gateway/pose_teller.hpp"

namespace qwsm::view {

/// Unpacks geometry_msgs/PoseWithCovarianceStamped. @throws io::MessageError where the bytes are
/// none; whether the numbers make sense is for the service to judge.
dds::ToldPose DecodeToldPose(std::string_view cdr);

}  // namespace qwsm::view
