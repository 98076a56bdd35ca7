// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "service/dds/robot/match_report_reader.hpp"
#include "service/dds/robot/robot_publisher.hpp"
#include "service/pipeline/network/answer_window.hpp"
#include "service/pipeline/network/pace.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/run/progress_display.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {

struct ReplayOptions {
  std::string robot;  ///< Namespace of the robot; empty for none.
  /// Seconds of the record in one of ours; nothing: as fast as scans are answered.
  std::optional<double> factor;
  ProgressStyle progress = ProgressStyle::kNone;
};

/// Publishes recorded scans as a robot does.
/// @tparam Kind of the scans. @tparam Source has Peek(), Next() and progress(), and maybe imu() and
/// T_odom_end(), as LogSource.
template <class Kind, class Source>
class NetworkReplay {
 public:
  /// Makes a replay. @param source outlives this; has a scan.
  NetworkReplay(const dds::NetworkOptions& network, const ReplayOptions& options, Source& source)
      : source_(source),
        participant_(network),
        reports_(participant_, {options.robot}),
        robot_(participant_,
               dds::RobotNames(options.robot),
               source.Peek()->T_odom_robot ? dds::OdometryUse::kPublished : dds::OdometryUse::kNone,
               HasImu(source) ? dds::ImuUse::kPublished : dds::ImuUse::kNone),
        window_(reports_, kScansOnTheirWay),
        progress_(options.progress) {
    if (options.factor) pace_.emplace(*options.factor);
  }

  /// Waits until somebody listens.
  /// @param T_robot_sensor of the first scan.
  /// @returns false where nobody does.
  bool WaitForListener(const typename Kind::Pose& T_robot_sensor,
                       std::chrono::duration<double> timeout,
                       const Interruption& interruption) {
    const auto until = Clock::now() + std::chrono::round<std::chrono::nanoseconds>(timeout);
    while (!interruption.requested() && Clock::now() < until) {
      if (robot_.WaitForListener(T_robot_sensor, kLook)) {
        WaitForReporter();
        return true;
      }
    }
    return false;
  }

  /// Publishes all scans of the source. @returns whether all was published.
  bool Run(const Interruption& interruption) {
    while (const auto observation = source_.Next()) {
      while (pace_ && !pace_->WaitFor(observation->scan.stamp, kLook)) {
        if (interruption.requested()) return false;
      }
      if (interruption.requested()) return false;
      PublishImu();
      if (!robot_.Publish(*observation, OdometryAtEnd())) ++late_;
      if (!pace_) KeepToAnswers(observation->scan.stamp);
      ShowProgress();
    }
    if (!pace_ && is_answered_) window_.WaitForAll(kPatience);
    robot_.Finish(kPatience);
    progress_.Clear();
    return true;
  }

  /// Whether answers were waited for, and none came.
  bool is_ignored() const { return !pace_ && is_answered_ && window_.answered() == 0; }

  std::string Summary(std::chrono::duration<double> time) const {
    std::string text = fmt::format("published      {} scans in {:.1f} s\n",
                                   WithThousands(source_.progress().scans),
                                   time.count());
    if (!pace_) {
      text += fmt::format("answered       {}, dropped by the service {}\n",
                          WithThousands(window_.answered()),
                          window_.dropped());
    }
    if (late_ > 0) text += fmt::format("late           {} scans waited for a listener\n", late_);
    return text;
  }

 private:
  using Clock = std::chrono::steady_clock;

  // Most scans on their way; the service's queue holds more than this.
  static constexpr std::size_t kScansOnTheirWay = 4;
  static constexpr auto kLook = std::chrono::milliseconds(200);

  static bool HasImu(const Source& source) {
    if constexpr (requires { source.has_imu(); }) return source.has_imu();
    return false;
  }
  void PublishImu() {
    if constexpr (requires { source_.imu(); }) {
      if (has_imu_) robot_.PublishImu(source_.imu());
    }
  }

  /// Of scans taken in motion, which are published as they were measured.
  std::optional<typename Kind::Pose> OdometryAtEnd() const {
    if constexpr (requires { source_.T_odom_end(); }) return source_.T_odom_end();
    return std::nullopt;
  }

  /// Waits for a reporter: a service that hears the robot reports on it a moment later.
  void WaitForReporter() {
    const auto until = Clock::now() + std::chrono::seconds(2);
    while (!reports_.has_writer() && Clock::now() < until) {
      reports_.Take(std::chrono::milliseconds(10));
    }
    is_answered_ = reports_.has_writer();
    if (!pace_ && !is_answered_) {
      messages::Warn("no service reports on the scans; paced by acknowledgments only");
    }
  }

  void KeepToAnswers(Timestamp stamp) {
    if (!is_answered_) {
      robot_.WaitForAcknowledgments(kPatience);
      return;
    }
    window_.NoteSent(stamp);
    if (!window_.WaitForRoom(kPatience)) {
      messages::Warn("no answer for {} s; going on", std::chrono::seconds(kPatience).count());
    }
  }

  void ShowProgress() {
    progress_.Show([this](std::chrono::duration<double> elapsed) {
      return ProgressLine("replay", source_.progress(), elapsed);
    });
  }

  Source& source_;
  dds::Participant participant_;
  dds::BasicReportReader<Kind> reports_;
  dds::BasicRobotPublisher<Kind> robot_;
  BasicAnswerWindow<Kind> window_;
  std::optional<Pace> pace_;
  StatusLine progress_;
  bool has_imu_ = HasImu(source_);  // Asked after a look at the first scan.
  bool is_answered_ = false;
  std::size_t late_ = 0;
};

}  // namespace qwsm::pipeline
