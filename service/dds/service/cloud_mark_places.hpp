// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/dds/service/mark_exchange.hpp"
#include "service/team/sinks/cloud_sink.hpp"

namespace qwsm::dds {

/// Moves marks with the models of robots that scan in space, whose paths are corrected as they
/// grow. A mark lies in the plane of the map, as it is seen from above.
class CloudMarkPlaces final : public team::CloudSink {
 public:
  /// @param marks outlives this.
  explicit CloudMarkPlaces(MarkExchange& marks) : marks_(marks) {}

  void TakeMap(const team::CloudMap& map) override;

 private:
  MarkExchange& marks_;
};

}  // namespace qwsm::dds
