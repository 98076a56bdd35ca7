// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/service_manager.hpp"

#include <systemd/sd-daemon.h>

namespace qwsm::apps {

ServiceManager::ServiceManager() {
  std::uint64_t microseconds = 0;
  if (sd_watchdog_enabled(0, &microseconds) > 0)
    watchdog_ = std::chrono::microseconds(microseconds);
}

void ServiceManager::TellReady(const std::string& status) const {
  sd_notify(0, ("READY=1\nSTATUS=" + status).c_str());
}

void ServiceManager::TellStopping() const { sd_notify(0, "STOPPING=1"); }

void ServiceManager::TellAlive(const std::string& status) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + (watchdog_ ? *watchdog_ / 3 : std::chrono::microseconds(1'000'000));
  sd_notify(0, ("WATCHDOG=1\nSTATUS=" + status).c_str());
}

}  // namespace qwsm::apps
