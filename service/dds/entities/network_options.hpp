// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace qwsm::dds {

/// Says which network is used, and which part of its traffic.
struct NetworkOptions {
  int domain = -1;
  std::string interface;
  std::string tag;
  std::string node = "qwsm";
  bool humble = false;
};

template <class Visitor>
void Describe(Visitor& visit, NetworkOptions& o) {
  visit("domain",
        o.domain,
        {.help = "DDS domain; -1: what ROS_DOMAIN_ID says, else 0", .min = -1, .max = 230});
  visit(
      "interface",
      o.interface,
      {.help = "network interface, such as lo or eth0; empty: what CYCLONEDDS_URI says, else all"});
  visit("tag",
        o.tag,
        {.help = "only programs with the same tag see each other; ROS 2 nodes have none"});
  visit("node", o.node, {.help = "name in the ROS graph"});
  visit("humble",
        o.humble,
        {.help = "be visible to ROS 2 Humble and older, not to Iron and newer; data reach both"});
}

}  // namespace qwsm::dds
