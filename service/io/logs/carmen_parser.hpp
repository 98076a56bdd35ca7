// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string_view>

#include "service/io/logs/log_parser.hpp"

namespace qwsm::io {

/// CARMEN logs, one message per line, ending in `ipc_timestamp ipc_hostname logger_timestamp`
/// (header and reader of CARMEN's logger; carmen.sourceforge.net/logger_playback.html).
class CarmenParser final : public LogParser {
 public:
  /// Says how the line of a sweep is laid out.
  struct SweepLayout {
    std::string_view message;
    std::string_view laser;
    /// Whether the line begins with the scanner's configuration, and has remissions.
    bool configured;
    bool posed;  ///< Whether the line has the poses of laser and robot.
  };

  explicit CarmenParser(std::optional<double> field_of_view_rad)
      : field_of_view_rad_(field_of_view_rad) {}

  /// Whether `line` is a message of CARMEN.
  static bool Recognizes(std::string_view line);

  std::string_view format() const override { return "CARMEN"; }
  ParsedLine Parse(std::string_view line) override;

 private:
  /// Where the log's parameters say a laser sits.
  struct Mounting {
    std::string_view laser;
    std::string_view parameter;  ///< Name of the parameter without the axis.
    Pose2 T_robot_laser;
    bool known = false;
  };

  ParsedLine ParseParameter(FieldReader fields);
  ParsedLine ParseSweep(const SweepLayout& layout, FieldReader fields) const;
  const Mounting* MountingOf(std::string_view laser) const;

  std::optional<double> field_of_view_rad_;
  std::array<Mounting, 2> mountings_{
      Mounting{.laser = "front", .parameter = "robot_frontlaser", .T_robot_laser = {}},
      // The rear laser looks back unless told otherwise.
      Mounting{.laser = "rear",
               .parameter = "robot_rearlaser",
               .T_robot_laser = {0.0, 0.0, std::numbers::pi}}};
};

}  // namespace qwsm::io
