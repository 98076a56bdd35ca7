// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace qwsm::config {

/// How many letters have to be inserted, removed, replaced or swapped with their neighbour to turn
/// one word into the other (optimal string alignment). O(a.size() * b.size()).
int EditDistance(std::string_view a, std::string_view b);

/// The name that was probably meant, or nothing where none is near: at most a third of its letters
/// may differ.
std::optional<std::string> ClosestName(std::string_view typed, std::span<const std::string> names);

/// `; did you mean 'x'?` to append to a message, or nothing.
std::string DidYouMean(std::string_view typed, std::span<const std::string> names);

}  // namespace qwsm::config
