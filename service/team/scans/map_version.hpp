// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace qwsm::team {

/// Which map it was, and how often it was corrected by then. Scans keep their ids where only that
/// changes.
struct MapVersion {
  std::uint64_t map = 0;
  std::uint32_t epoch = 0;

  friend bool operator==(const MapVersion&, const MapVersion&) = default;
};

}  // namespace qwsm::team
