// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "service/team/marks/mark.hpp"

namespace qwsm::view {

/// Unpacks what a client says with qwsm_msgs/Mark, as far as that is the client's to say: number
/// and anchor are left to the service. @throws io::MessageError where the bytes are none, or no
/// mark that could be drawn.
team::Mark DecodeToldMark(std::string_view cdr);

}  // namespace qwsm::view
