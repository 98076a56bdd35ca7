// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "service/dds/gateway/mark.hpp"

namespace qwsm::view {

/// Unpacks qwsm_msgs/Mark. @throws io::MessageError where the bytes are none, or no mark that could
/// be drawn.
dds::Mark DecodeMark(std::string_view cdr);

/// What is wrong with a mark; empty where it can be drawn and kept.
std::string_view ObjectionTo(const dds::Mark& mark);

}  // namespace qwsm::view
