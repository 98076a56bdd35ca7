// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "service/dds/entities/participant.hpp"

namespace qwsm::dds {

/// Makes the program visible as a node to `ros2 node list`, with the topics it reads and writes.
class RosGraph {
 public:
  /// Announces a node. @param participant outlives this.
  RosGraph(const Participant& participant, NetworkOptions options);
  ~RosGraph();

  /// Tells all readers and writers there are now; to be called after they change, by any thread.
  void Announce() const;

 private:
  class Topic;
  std::unique_ptr<Topic> topic_;
};

}  // namespace qwsm::dds
