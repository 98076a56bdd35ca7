// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace sim {

/// Spreads a number over all 64 bits (the finalizer of SplitMix64, Steele et al. 2014).
constexpr std::uint64_t Scramble(std::uint64_t number) {
  number += 0x9E3779B97F4A7C15U;
  number = (number ^ (number >> 30U)) * 0xBF58476D1CE4E5B9U;
  number = (number ^ (number >> 27U)) * 0x94D049BB133111EBU;
  return number ^ (number >> 31U);
}

/// The seed of one purpose under a common seed: a noise source that draws more or fewer numbers
/// does not change what the others draw.
constexpr std::uint64_t SeedFor(std::string_view purpose, std::uint64_t seed) {
  std::uint64_t mixed = Scramble(seed);
  for (const char letter : purpose) mixed = Scramble(mixed ^ static_cast<unsigned char>(letter));
  return mixed;
}

using RandomEngine = std::mt19937_64;

inline double Uniform(RandomEngine& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

}  // namespace sim
