// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/log_parser.hpp"

#include "service/io/logs/carmen_parser.hpp"
#include "service/io/logs/dpslam_parser.hpp"
#include "service/io/logs/player_parser.hpp"

namespace qwsm::io {

std::unique_ptr<LogParser> RecognizeFormat(std::string_view line,
                                           std::optional<double> field_of_view_rad) {
  if (CarmenParser::Recognizes(line)) return std::make_unique<CarmenParser>(field_of_view_rad);
  if (PlayerParser::Recognizes(line)) return std::make_unique<PlayerParser>();
  if (DpslamParser::Recognizes(line)) return std::make_unique<DpslamParser>(field_of_view_rad);
  return nullptr;
}

}  // namespace qwsm::io
