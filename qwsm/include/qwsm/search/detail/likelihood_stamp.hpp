// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace qwsm {

/// How likelihood exp(-d^2 / 2 sigma^2) falls from cell to cell.
struct LikelihoodFall {
  LikelihoodFall(double cell_size_m, double sigma_m);

  double cell_size_m;
  double sigma_m;
  double step_sigmas;    ///< Side of a cell.
  double step_share;     ///< exp(-step^2 / 2)
  double squared_share;  ///< exp(-step^2)
  int reach;             ///< So many cells around a point its likelihood is worth storing.
};

/// Likelihood around a point along one axis, at consecutive cells.
class LikelihoodProfile {
 public:
  int first() const { return first_; }
  int last() const { return last_; }
  /// @pre first() <= cell <= last(), or the one after
  const double* At(int cell) const { return values_.data() + (cell - first_); }

  /// Lays the profile about a point, at the middles of cells. It falls to both sides.
  /// @param cell the one that holds the point.
  void CenterAt(double center_m, int cell, const LikelihoodFall& fall);
  /// Makes this the profile of cells s = 2^shift times as wide as those of one that was centred at
  /// a point: c holds the greatest value over s c .. s c + s - 1.
  void Coarsen(const LikelihoodProfile& fine, int shift);

 private:
  int first_ = 0;
  int last_ = -1;
  std::vector<double> values_;
};

/// Likelihoods that a point gives the cells around it: a Gaussian, the product of its profiles
/// along both axes, scaled to 0..255 and cut off.
class LikelihoodStamp {
 public:
  /// Rows may be read so far beyond their ends, where they hold zeros.
  static constexpr int kPadding = 16;

  /// Multiplies the profiles.
  void Make(const LikelihoodProfile& columns, const LikelihoodProfile& rows);

  /// Likelihoods of a row of cells, from the profile's first column on. @pre it is of the profile
  const std::uint8_t* Row(int row) const {
    return likelihoods_.data() + (row - first_row_) * stride_ + kPadding;
  }
  /// First and last row in which the point makes cells count as mapped.
  int first_mapped() const { return first_mapped_; }
  int last_mapped() const { return last_mapped_; }

 private:
  int first_row_ = 0;
  int first_mapped_ = 0;
  int last_mapped_ = -1;
  int stride_ = 0;
  std::vector<double> lanes_;  // The profile of the columns, in an order to be multiplied in.
  std::vector<std::uint8_t> likelihoods_;  // Row by row, each between two paddings.
};

}  // namespace qwsm
