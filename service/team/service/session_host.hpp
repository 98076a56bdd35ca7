// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "service/team/journal/service_journal.hpp"
#include "service/team/service/periodic_task.hpp"
#include "service/team/service/service_options.hpp"
#include "service/team/session/session_list.hpp"

namespace qwsm::team {

/// Runs a service, whatever its robots' sensors are: their sessions, the journal of their scans,
/// and the threads that tell how the service is and what its maps are.
template <class Session>
class SessionHost {
 public:
  using Sessions = SessionList<Session>;

  /// What a service tells again and again while it works.
  struct News {
    std::function<void()> tell_status;
    PeriodicTask::Task tell_maps;  ///< Tells the maps, in the background.
    std::chrono::duration<double> map_period{};
  };

  /// Opens the journal.
  /// @param options outlive this.
  /// @throws io::JournalError where it cannot be opened or is no journal.
  SessionHost(const ServiceOptions& options,
              const ServiceJournal::Place& place,
              TellEvent tell,
              typename Sessions::Make make)
      : options_(options),
        sessions_(std::move(make)),
        journal_(options.service, place, std::move(tell)) {}

  const std::string& identity() const { return journal_.identity(); }
  Sessions& sessions() { return sessions_; }
  const Sessions& sessions() const { return sessions_; }
  ServiceJournal& journal() { return journal_; }

  /// Gives all entries of the journal to `take`.
  void Restore(const std::function<void(const io::JournalEntry&)>& take) { journal_.Restore(take); }
  /// Expects the configured robots from now on. @pre the map is what the journal says: each goes on
  /// where it was.
  void ExpectRobots() {
    for (const RobotStartOptions& robot : options_.robots) sessions_.Of(robot.name);
  }

  void Start(News news) {
    sessions_.Start(options_.threads);
    if (options_.map_period_s > 0.0) {
      mapping_ = std::make_unique<PeriodicTask>(news.map_period, true, std::move(news.tell_maps));
    }
    reporting_ = std::make_unique<PeriodicTask>(
        std::chrono::duration<double>(options_.status_period_s),
        false,
        [tell = std::move(news.tell_status)](const std::stop_token&) { tell(); });
  }
  /// Finishes the scans at work, saves what is to be saved, and works no more.
  void Stop() {
    mapping_.reset();
    reporting_.reset();
    sessions_.Stop();
    journal_.Stop();
  }
  /// Waits until every scan that was taken is answered or dropped, and all that can be is on disk.
  void WaitUntilIdle() {
    sessions_.WaitUntilIdle();
    journal_.WaitUntilSettled();
  }

  /// How the service is. @param map which only the service knows.
  TeamStatus Status(const MapStatus& map) const {
    return {.service = identity(),
            .uptime = std::chrono::steady_clock::now() - begun_,
            .robots = sessions_.Statuses(),
            .map = map,
            .journal = journal_.Status()};
  }

 private:
  const ServiceOptions& options_;
  const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  Sessions sessions_;
  ServiceJournal journal_;
  std::unique_ptr<PeriodicTask> mapping_;
  std::unique_ptr<PeriodicTask> reporting_;
};

}  // namespace qwsm::team
