// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/layouts/campus.hpp"
#include "sim/layouts/corridor.hpp"
#include "sim/layouts/office.hpp"
#include "sim/layouts/park.hpp"
#include "sim/layouts/place.hpp"
#include "sim/layouts/rubble.hpp"

namespace sim {

enum class LayoutKind { kEmpty, kPark, kCorridor, kOffice, kRubble, kCampus };

inline std::span<const std::pair<std::string_view, LayoutKind>> Names(LayoutKind) {
  static constexpr std::array<std::pair<std::string_view, LayoutKind>, 6> kNames{
      {{"empty", LayoutKind::kEmpty},
       {"park", LayoutKind::kPark},
       {"corridor", LayoutKind::kCorridor},
       {"office", LayoutKind::kOffice},
       {"rubble", LayoutKind::kRubble},
       {"campus", LayoutKind::kCampus}}};
  return kNames;
}

/// Says which place to lay out, and how; the options of the other places are not looked at.
struct LayoutOptions {
  LayoutKind kind = LayoutKind::kEmpty;
  ParkOptions park;
  CorridorOptions corridor;
  OfficeOptions office;
  RubbleOptions rubble;
  CampusOptions campus;
};

template <class Visitor>
void Describe(Visitor& visit, LayoutOptions& o) {
  visit("kind", o.kind, {.help = "the place to lay out"});
  visit("park", o.park, {.help = "how a park is laid out"});
  visit("corridor", o.corridor, {.help = "how a corridor is laid out"});
  visit("office", o.office, {.help = "how an office is laid out"});
  visit("rubble", o.rubble, {.help = "how a collapsed floor is laid out"});
  visit("campus", o.campus, {.help = "how a campus is laid out"});
}

/// Lays out a place. The same options and seed give the same place.
Place MakePlace(const LayoutOptions& options, std::uint64_t seed);

}  // namespace sim
