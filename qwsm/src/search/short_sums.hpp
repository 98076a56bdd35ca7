// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "qwsm/search/likelihood_window.hpp"

namespace qwsm {

// Every processor of the last twenty years adds eight sums at once, and compares sixteen bytes.
using EightSums = std::uint16_t __attribute__((vector_size(16)));
using SixteenBytes = std::uint8_t __attribute__((vector_size(16)));
static_assert(std::endian::native == std::endian::little);

inline SixteenBytes LoadSixteen(const std::uint8_t* bytes) {
  SixteenBytes sixteen;
  std::memcpy(&sixteen, bytes, sizeof(sixteen));
  return sixteen;
}

inline std::uint32_t LoadFour(const std::uint8_t* bytes) {
  std::uint32_t four = 0;
  std::memcpy(&four, bytes, sizeof(four));
  return four;
}

inline SixteenBytes GreaterOf(SixteenBytes a, SixteenBytes b) { return a > b ? a : b; }

// The first and the last eight of bytes as numbers of 16 bits: interleaved with zeros.
inline EightSums WidenedFirst(SixteenBytes bytes) {
  return std::bit_cast<EightSums>(__builtin_shufflevector(
      bytes, SixteenBytes{}, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
}
inline EightSums WidenedLast(SixteenBytes bytes) {
  return std::bit_cast<EightSums>(__builtin_shufflevector(
      bytes, SixteenBytes{}, 8, 16, 9, 17, 10, 18, 11, 19, 12, 20, 13, 21, 14, 22, 15, 23));
}
// Eight bytes, the first one lowest, as numbers of 16 bits.
inline EightSums Widened(std::uint64_t eight) {
  using Words = std::uint64_t __attribute__((vector_size(16)));
  return WidenedFirst(std::bit_cast<SixteenBytes>(Words{eight, 0}));
}

// Whether any comparison was true.
inline bool IsAny(EightSums compared) {
  using Words = std::uint64_t __attribute__((vector_size(16)));
  const auto words = std::bit_cast<Words>(compared);
  return (words[0] | words[1]) != 0;
}

// No more bytes fit a sum of 16 bits, and no sum is larger.
inline constexpr std::size_t kMostSummands = 256;
inline constexpr int kLargestShortSum = 255 * 256;

// The sums of up to kMostSummands blocks of bytes, of so many rows of eight each.
// @tparam kStride from row to row.
template <int kRows, int kStride>
class SumsOfRows {
 public:
  using Sums = LikelihoodWindow::BlockSums;

  // @param row where the first row is.
  void Add(const std::uint8_t* row) {
    for (EightSums& sums : rows_) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, row, sizeof(eight));
      sums += Widened(eight);
      row += kStride;
    }
  }
  // Whether any is as large.
  bool AnyReaches(std::uint16_t value) const {
    auto reached = rows_.front() >= value;
    for (const EightSums& sums : rows_) reached |= sums >= value;
    return IsAny(std::bit_cast<EightSums>(reached));
  }
  void AddTo(Sums& sums) const {
    auto sum = sums.begin();
    for (const EightSums& row : rows_) {
      for (int column = 0; column < LikelihoodWindow::kBlocks; ++column) *sum++ += row[column];
    }
  }

 private:
  std::array<EightSums, kRows> rows_{};
};

// Likewise of four rows of four.
template <int kStride>
class SumsOfSquares {
 public:
  using Sums = LikelihoodWindow::OffsetSums;

  void Add(const std::uint8_t* first) {
    using FourRows = std::uint32_t __attribute__((vector_size(16)));
    const auto row = [first](int i) { return LoadFour(first + i * kStride); };
    const auto bytes = std::bit_cast<SixteenBytes>(FourRows{row(0), row(1), row(2), row(3)});
    upper_ += WidenedFirst(bytes);
    lower_ += WidenedLast(bytes);
  }
  bool AnyReaches(std::uint16_t value) const {
    return IsAny(std::bit_cast<EightSums>((upper_ >= value) | (lower_ >= value)));
  }
  void AddTo(Sums& sums) const {
    for (std::size_t i = 0; i < 8; ++i) {
      sums[i] += upper_[i];
      sums[i + 8] += lower_[i];
    }
  }

 private:
  EightSums upper_{};
  EightSums lower_{};
};

}  // namespace qwsm
