// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/mark_reader.hpp"

#include "service/dds/wire/mark_conversion.hpp"
#include "service/dds/wire/robot_names.hpp"

namespace qwsm::dds {

MarkReader::MarkReader(const Participant& participant)
    : reader_(participant, kMarksTopic, Profile::kMarks) {}

std::vector<team::Mark> MarkReader::Take() const {
  std::vector<team::Mark> marks;
  reader_.TakeAll([&marks](const wire::Mark& sample) {
    if (ObjectionTo(sample).empty()) marks.push_back(FromWire(sample));
  });
  return marks;
}

}  // namespace qwsm::dds
