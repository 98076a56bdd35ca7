// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "service/dds/entities/reader.hpp"

namespace qwsm::dds {

/// A sample as it went over the wire. Copies share its bytes, which the middleware keeps for them.
struct RawSample {
  std::shared_ptr<const void> owner;
  std::string_view cdr;        ///< With the head of four bytes that tells the encoding.
  std::uint64_t stamp_ns = 0;  ///< When it was published, since 1970.
};

/// Receives samples of any type without unpacking them.
class RawReader : public UntypedReader {
 public:
  using UntypedReader::UntypedReader;

  /// Calls `take` with every sample that has arrived, in order.
  void TakeAll(const std::function<void(RawSample)>& take) const;
};

}  // namespace qwsm::dds
