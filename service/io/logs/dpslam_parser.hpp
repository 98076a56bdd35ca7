// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "service/io/logs/log_parser.hpp"

namespace qwsm::io {

/// Logs of DP-SLAM (Eliazar & Parr): pairs of `Odometry x y theta` and `Laser count range...`.
///
/// They have no time: each pair is given a tenth of a second.
class DpslamParser final : public LogParser {
 public:
  explicit DpslamParser(std::optional<double> field_of_view_rad)
      : field_of_view_rad_(field_of_view_rad) {}

  static bool Recognizes(std::string_view line);

  std::string_view format() const override { return "DP-SLAM"; }
  bool has_stamps() const override { return false; }
  ParsedLine Parse(std::string_view line) override;

 private:
  ParsedLine ParseOdometry(FieldReader fields);
  ParsedLine ParseLaser(FieldReader fields);
  Timestamp Stamp() const;

  std::optional<double> field_of_view_rad_;
  std::int64_t pairs_ = 0;             // Pairs begun so far.
  std::optional<Pose2> T_odom_robot_;  // Odometry of the pair whose sweep is to come.
};

}  // namespace qwsm::io
