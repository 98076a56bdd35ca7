// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>

#include "service/dds/entities/participant.hpp"

namespace qwsm::dds {

/// Notices when several participants send what only one should, as robots of one name do: they
/// take turns. One that is started again does not, for the one before it is heard no more.
class SourceWatch {
 public:
  /// Notes who sent a sample. @return whether several are known to, for the first time.
  bool Note(const Guid& participant);

 private:
  Guid last_{};
  std::set<Guid> earlier_;
  bool is_told_ = false;
};

}  // namespace qwsm::dds
