// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/network.hpp"

namespace qwsm::test {

/// Two computers on a switch, out of which the cable of the second may be pulled and put back: on
/// this one, as network namespaces.
class CutNetwork {
 public:
  enum Side { kLeft, kRight };

  /// Whether namespaces can be made here: that needs root and `ip`.
  static bool IsPossible() {
    try {
      const CutNetwork probe;
      return true;
    } catch (const std::runtime_error&) {
      return false;
    }
  }

  /// @throws std::runtime_error where it is not possible.
  CutNetwork() {
    try {
      for (const std::string& name : names_) Do("netns add " + name);
      Do("-n " + names_[kSwitch] + " link add switch type bridge stp_state 0 mcast_snooping 0");
      Do("-n " + names_[kSwitch] + " link set switch up");
      for (const Side side : {kLeft, kRight}) PlugIn(side);
    } catch (const std::runtime_error&) {
      Remove();
      throw;
    }
  }
  CutNetwork(const CutNetwork&) = delete;
  CutNetwork& operator=(const CutNetwork&) = delete;
  ~CutNetwork() { Remove(); }

  void Cut() const { Do("-n " + names_[kSwitch] + " link set right nomaster"); }
  void Heal() const { Do("-n " + names_[kSwitch] + " link set right master switch"); }

  /// Takes the network interface of a computer down.
  void TakeDown(Side side) const {
    Do("-n " + names_.at(side) + " link set " + PortOf(side) + " down");
  }

  /// Starts a program on one of the computers.
  std::unique_ptr<Daemon> Start(Side side, std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--set", std::string("network.interface=") + PortOf(side)});
    const std::filesystem::path network = "/run/netns/" + names_.at(side);
    return std::make_unique<Daemon>(std::move(arguments),
                                    Redirection{.output = {}, .network_namespace = network});
  }

 private:
  static constexpr std::size_t kSwitch = 2;

  static std::string PortOf(Side side) { return side == kLeft ? "left" : "right"; }

  void PlugIn(Side side) const {
    const std::string& computer = names_.at(side);
    const std::string port = PortOf(side);
    Do("link add " + port + " netns " + computer + " type veth peer name " + port + " netns " +
       names_[kSwitch]);
    Do("-n " + computer + " address add 10.99.0." + std::to_string(side + 1) + "/24 dev " + port);
    for (const std::string& link : {std::string("lo"), port}) {
      Do("-n " + computer + " link set " + link + " up");
    }
    Do("-n " + names_[kSwitch] + " link set " + port + " master switch up");
  }

  static void Do(const std::string& what) {
    const std::string command = "ip " + what + " >/dev/null 2>&1";
    if (std::system(command.c_str()) != 0) throw std::runtime_error("cannot: ip " + what);
  }

  void Remove() const {
    for (const std::string& name : names_) {
      const std::string command = "ip netns delete " + name + " >/dev/null 2>&1";
      [[maybe_unused]] const int ignored = std::system(command.c_str());
    }
  }

  std::array<std::string, 3> names_{"qwsm-left-" + std::to_string(getpid()),
                                    "qwsm-right-" + std::to_string(getpid()),
                                    "qwsm-switch-" + std::to_string(getpid())};
};

}  // namespace qwsm::test
