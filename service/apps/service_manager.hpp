// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace qwsm::apps {

/// Talks to systemd, where it has started the program (sd_notify); else to nobody.
class ServiceManager {
 public:
  ServiceManager();

  void TellReady(const std::string& status) const;
  void TellStopping() const;
  /// Shows signs of life, as often as the unit asks for; call it several times a second.
  void TellAlive(const std::string& status);

 private:
  std::optional<std::chrono::microseconds> watchdog_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace qwsm::apps
