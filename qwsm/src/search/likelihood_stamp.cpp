// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/detail/likelihood_stamp.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "qwsm/search/detail/likelihood_tile.hpp"

namespace qwsm {
namespace {

constexpr double kReachSigmas = 2.5;  // Beyond, the likelihood is not worth storing.
// Exponents are kept within doubles' range. Larger ones mean that nothing is left a cell away.
constexpr double kLargestExponent = 600.0;

// Side by side; every processor of the last twenty years computes with such groups.
using TwoColumns = double __attribute__((vector_size(16)));
using TwoLikelihoods = std::int32_t __attribute__((vector_size(8)));
using FourLikelihoods = std::int32_t __attribute__((vector_size(16)));
constexpr int kColumnsAtATime = 16;
static_assert(kColumnsAtATime == LikelihoodStamp::kPadding);

// Of sixteen columns number 4 i + k is lane i of the k-th four, so that the fours' products are
// bytes side by side as soon as those of the k-th are shifted by k bytes.
constexpr int LaneOf(int column) {
  return column / kColumnsAtATime * kColumnsAtATime + column % 4 * 4 + column % kColumnsAtATime / 4;
}

TwoLikelihoods TwoProducts(const double* lanes, const TwoColumns& of_row) {
  TwoColumns columns;
  std::memcpy(&columns, lanes, sizeof columns);
  return __builtin_convertvector(columns * of_row, TwoLikelihoods);
}

// @param lanes sixteen columns in that order.
void Multiply(const double* lanes, double of_row, std::uint8_t* likelihoods) {
  constexpr bool kIsLittle = std::endian::native == std::endian::little;
  const TwoColumns twice{of_row, of_row};
  FourLikelihoods bytes{};
  for (int k = 0; k < 4; ++k, lanes += 4) {
    const FourLikelihoods products = __builtin_shufflevector(
        TwoProducts(lanes, twice), TwoProducts(lanes + 2, twice), 0, 1, 2, 3);
    bytes |= products << (kIsLittle ? 8 * k : 24 - 8 * k);
  }
  std::memcpy(likelihoods, &bytes, sizeof bytes);
}

// Keeps memory that is there: numbers of cells go up and down by one.
void MakeRoom(std::vector<double>& values, int count) {
  if (values.size() < static_cast<std::size_t>(count))
    values.resize(static_cast<std::size_t>(count));
}

}  // namespace

LikelihoodFall::LikelihoodFall(double cell_size, double sigma)
    : cell_size_m(cell_size),
      sigma_m(sigma),
      step_sigmas(cell_size / sigma),
      step_share(std::exp(-0.5 * step_sigmas * step_sigmas)),
      squared_share(step_share * step_share),
      reach(static_cast<int>(std::ceil(kReachSigmas * sigma / cell_size))) {}

// exp(-(a + k h)^2 / 2) is exp(-(a + (k - 1) h)^2 / 2) times exp(-a h - h^2 / 2) exp(-h^2)^(k - 1),
// so that two exponentials tell all values. No ratio is above 1, but by rounding.
void LikelihoodProfile::CenterAt(double center_m, int cell, const LikelihoodFall& fall) {
  first_ = cell - fall.reach;
  last_ = cell + fall.reach;
  MakeRoom(values_, 2 * fall.reach + 1);
  const double sigmas = (fall.cell_size_m * (cell + 0.5) - center_m) / fall.sigma_m;
  const double skew =
      std::exp(std::clamp(fall.step_sigmas * sigmas, -kLargestExponent, kLargestExponent));
  double* center = &values_[static_cast<std::size_t>(fall.reach)];
  *center = std::exp(-0.5 * sigmas * sigmas);
  double above = *center;
  double below = *center;
  double ratio_above = std::min(1.0, fall.step_share / skew);
  double ratio_below = std::min(1.0, fall.step_share * skew);
  for (int i = 1; i <= fall.reach; ++i) {
    center[i] = above *= ratio_above;
    center[-i] = below *= ratio_below;
    ratio_above *= fall.squared_share;
    ratio_below *= fall.squared_share;
  }
}

// Of what falls to both sides, the greatest value is the one nearest to the middle.
void LikelihoodProfile::Coarsen(const LikelihoodProfile& fine, int shift) {
  const int center = fine.first_ + (fine.last_ - fine.first_) / 2;
  first_ = fine.first_ >> shift;
  last_ = fine.last_ >> shift;
  MakeRoom(values_, last_ - first_ + 1);
  double* value = values_.data();
  for (int cell = first_; cell <= last_; ++cell) {
    const int from = std::max(fine.first_, cell << shift);
    const int to = std::min(fine.last_, ((cell + 1) << shift) - 1);
    *value++ = *fine.At(std::clamp(center, from, to));
  }
}

void LikelihoodStamp::Make(const LikelihoodProfile& columns, const LikelihoodProfile& rows) {
  const int width = columns.last() - columns.first() + 1;
  const int whole = (width + kColumnsAtATime - 1) / kColumnsAtATime * kColumnsAtATime;
  first_row_ = rows.first();
  stride_ = whole + 2 * kPadding;
  likelihoods_.resize(static_cast<std::size_t>((rows.last() - rows.first() + 1) * stride_));
  lanes_.assign(static_cast<std::size_t>(whole), 0.0);
  const double* of_column = columns.At(columns.first());
  for (int i = 0; i < width; ++i) lanes_[static_cast<std::size_t>(LaneOf(i))] = of_column[i];
  first_mapped_ = rows.last() + 1;
  last_mapped_ = rows.first() - 1;
  const double* lanes = lanes_.data();
  const double* of_row = rows.At(rows.first());
  std::uint8_t* likelihoods = likelihoods_.data() + kPadding;
  for (int row = rows.first(), end = rows.last() + 1; row < end; ++row, ++of_row) {
    for (int i = 0; i < whole; i += kColumnsAtATime) {
      Multiply(lanes + i, 255.0 * *of_row, likelihoods + i);
    }
    const std::uint8_t greatest = likelihoods[width / 2];
    likelihoods += whole + 2 * kPadding;
    if (greatest < LikelihoodTile::kMapped) continue;
    first_mapped_ = std::min(first_mapped_, row);
    last_mapped_ = row;
  }
}

}  // namespace qwsm
