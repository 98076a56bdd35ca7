// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace qwsm::apps {

/// The release and the commit it was built from, where that is known, such as `0.1.0 (1a2b3c4)`.
std::string_view Version();

}  // namespace qwsm::apps
