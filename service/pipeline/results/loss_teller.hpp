// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "qwsm/correction/self_correcting_mapper.hpp"

namespace qwsm::pipeline {

/// Tells when a robot that maps is lost, and when it is found again.
class LossTeller {
 public:
  /// @pre the mapper outlives this.
  explicit LossTeller(const SelfCorrectingMapper& mapper) : mapper_(mapper) {}

  /// Takes the answer to the next scan.
  void Take(const MappingStep& step);
  /// Tells of a robot that is lost in the end.
  void Finish() const;

 private:
  const SelfCorrectingMapper& mapper_;
  std::size_t scans_ = 0;
  std::size_t losses_ = 0;
  bool is_lost_ = false;
};

}  // namespace qwsm::pipeline
