// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "service/dds/entities/reader.hpp"
#include "service/team/marks/mark.hpp"

namespace qwsm::dds {

/// Hears the marks on the map: all there are, and those that come.
class MarkReader {
 public:
  /// Subscribes. @throws DdsError.
  explicit MarkReader(const Participant& participant);

  /// All marks that arrived since the last call, of an id maybe several; those that make no sense
  /// are left out.
  std::vector<team::Mark> Take() const;

 private:
  Reader<wire::Mark> reader_;
};

}  // namespace qwsm::dds
