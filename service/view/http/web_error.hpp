// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace qwsm::view {

/// Tells that nobody can be served; the text names setting or address and says how to mend it.
class WebError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace qwsm::view
