// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "service/dds/service/mark_exchange.hpp"
#include "service/dds/service/ros_graph.hpp"
#include "service/view/view_options.hpp"

namespace qwsm::view {

/// Shows in browsers what happens on the network, and takes from them where robots are.
class LiveView {
 public:
  /// What a service says of itself to its view.
  struct Service {
    std::string name;                              ///< For those who look.
    dds::MarkExchange& marks;                      ///< Told what operators mark.
    std::function<void(const std::string&)> warn;  ///< Told what cannot be shown, in any thread.
  };

  /// Begins to serve.
  /// @param participant, graph and the service's marks outlive this.
  /// @throws WebError, dds::DdsError.
  LiveView(const dds::Participant& participant,
           const dds::RosGraph& graph,
           const ViewOptions& options,
           Service service);
  ~LiveView();

  /// Where the page is, for a browser on this computer.
  std::string url() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace qwsm::view
