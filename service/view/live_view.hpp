// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "service/dds/service/ros_graph.hpp"
#include "service/view/view_options.hpp"

namespace qwsm::view {

/// Shows in browsers what happens on the network, and takes from them where robots are.
class LiveView {
 public:
  /// Begins to serve.
  /// @param participant and graph outlive this.
  /// @param name of the service, for those who look.
  /// @param warn is told what cannot be shown, in any thread.
  /// @throws WebError, dds::DdsError.
  LiveView(const dds::Participant& participant,
           const dds::RosGraph& graph,
           const ViewOptions& options,
           const std::string& name,
           std::function<void(const std::string&)> warn);
  ~LiveView();

  /// Where the page is, for a browser on this computer.
  std::string url() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace qwsm::view
