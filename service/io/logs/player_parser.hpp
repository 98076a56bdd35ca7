// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "service/io/logs/log_parser.hpp"

namespace qwsm::io {

/// Text logs of Player's writelog driver and of its forerunners.
///
///             interface index sensor_time                      data   (before writelog)
///   time host port  interface index sensor_time  data   (1.x: file versions 0.0 and 0.1)
///   time host robot interface index type subtype data   (2.x: 0.2 and 0.3; 3.x writes the same)
///
/// Of `laser` the plain scans (1:1), those with a pose (1:2) and the mounting (4:1) are understood,
/// of `position` and `position2d` the state, of `truth` the pose.
class PlayerParser final : public LogParser {
 public:
  /// Whether `line` is a message, or the heading, of a Player log.
  static bool Recognizes(std::string_view line);

  std::string_view format() const override { return "Player"; }
  ParsedLine Parse(std::string_view line) override;

 private:
  struct Header;

  static std::optional<Header> ReadHeader(FieldReader& fields);
  ParsedLine ParseLaser(const Header& header, FieldReader fields);
  ParsedLine ParseBeams(const Header& header, FieldReader fields);
  ParsedLine Complete(const Header& header, Sweep sweep);
  ParsedLine ParseMounting(const Header& header, FieldReader fields);
  ParsedLine ParsePosition(const Header& header, FieldReader fields);
  static std::string NameOf(const Header& header);
  bool IsOtherRobot(const Header& header);

  std::string robot_;  // Host and port, or host and robot, of the first message.
  std::map<std::size_t, Pose2> T_robot_laser_;  // Mountings, by index of the device.
  std::optional<std::size_t> position_index_;
};

}  // namespace qwsm::io
