// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/protocol/told_mark.hpp"

#include <string>

#include "service/io/bags/messages/message_reader.hpp"

namespace qwsm::view {

team::Mark DecodeToldMark(std::string_view cdr) {
  io::MessageReader reader(cdr, io::Encoding::kCdr);
  static_cast<void>(reader.Unsigned32());  // Operators' clocks differ: the service's counts.
  static_cast<void>(reader.Unsigned32());
  static_cast<void>(reader.String());  // There is one map.
  team::Mark mark;
  for (std::string* text : {&mark.id, &mark.kind, &mark.text, &mark.author})
    *text = reader.String();
  mark.p_map_m.x() = reader.Double();
  mark.p_map_m.y() = reader.Double();
  mark.is_removed = reader.Byte() != 0;
  if (const auto objection = ObjectionTo(mark); !objection.empty()) {
    throw io::MessageError(std::string(objection));
  }
  return mark;
}

}  // namespace qwsm::view
