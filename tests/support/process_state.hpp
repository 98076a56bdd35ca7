// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace qwsm::test {

/// What Linux tells of another process.

/// Memory that is in use, in kB.
inline double ResidentKilobytes(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  double total_pages = 0.0;
  double resident_pages = 0.0;
  file >> total_pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1024.0;
}

/// UDP ports on which it listens.
inline std::vector<std::uint16_t> UdpPorts(pid_t process) {
  const std::string folder = "/proc/" + std::to_string(process);
  std::set<std::string> sockets;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/fd")) {
    std::error_code gone;
    const std::string target = std::filesystem::read_symlink(entry.path(), gone).string();
    if (target.starts_with("socket:[")) sockets.insert(target.substr(8, target.size() - 9));
  }
  std::vector<std::uint16_t> ports;
  std::ifstream table(folder + "/net/udp");
  std::string line;
  std::getline(table, line);  // The names of the columns.
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string slot, address, remote, state, queues, timer, retransmissions, user, timeout, inode;
    fields >> slot >> address >> remote >> state >> queues >> timer >> retransmissions >> user >>
        timeout >> inode;
    if (!sockets.contains(inode)) continue;
    const std::string port = address.substr(address.find(':') + 1);
    ports.push_back(static_cast<std::uint16_t>(std::stoul(port, nullptr, 16)));
  }
  return ports;
}

}  // namespace qwsm::test
