// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "qwsm/sensor/laser_scan.hpp"
#include "service/dds/entities/wire_types.hpp"

namespace qwsm::dds {

/// Something that an operator marked on the map, see idl/qwsm_msgs/msg/Mark.msg.
struct Mark {
  Timestamp stamp{};  ///< Of one id, the newest counts.
  std::string frame = "map";
  std::string id{};
  std::string kind{};
  std::string text{};
  std::string author{};
  double x_m = 0.0;
  double y_m = 0.0;
  bool is_removed = false;
};

/// The mark as it is published; points into it.
wire::Mark ToWire(const Mark& mark);

}  // namespace qwsm::dds
