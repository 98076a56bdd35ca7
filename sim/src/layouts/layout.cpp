// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layouts/layout.hpp"

#include "sim/random.hpp"

namespace sim {

Place MakePlace(const LayoutOptions& options, std::uint64_t seed) {
  RandomEngine random(SeedFor("layout", seed));
  switch (options.kind) {
    case LayoutKind::kEmpty:
      return {};
    case LayoutKind::kPark:
      return MakePark(options.park, random);
    case LayoutKind::kCorridor:
      return MakeCorridor(options.corridor);
    case LayoutKind::kOffice:
      return MakeOffice(options.office, random);
    case LayoutKind::kRubble:
      return MakeRubble(options.rubble, random);
    case LayoutKind::kCampus:
      return MakeCampus(options.campus, random);
  }
  return {};
}

}  // namespace sim
