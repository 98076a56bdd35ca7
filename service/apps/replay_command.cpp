// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/network.hpp"
#include "service/dds/robot_publisher.hpp"
#include "service/pipeline/answer_window.hpp"
#include "service/pipeline/interruption.hpp"
#include "service/pipeline/log_source.hpp"
#include "service/pipeline/pace.hpp"
#include "service/pipeline/progress_display.hpp"

namespace qwsm::apps {
namespace {

using namespace std::chrono_literals;
using pipeline::Interruption;
using Clock = std::chrono::steady_clock;

struct ReplayArguments {
  std::vector<std::filesystem::path> logs;
  std::string robot;
  std::string rate = "1";
  double wait_s = 10.0;
  NetworkArguments network;
};

// The service's queue holds more than this.
constexpr std::size_t kScansOnTheirWay = 4;
constexpr auto kPatience = 10s;

/// Seconds of the log in one of ours; nothing for as fast as the service answers.
std::optional<double> FactorOf(const std::string& rate) {
  if (rate == "max") return std::nullopt;
  char* end = nullptr;
  const double factor = std::strtod(rate.c_str(), &end);
  if (end == rate.c_str() || *end != '\0' || !(factor > 0.0 && factor <= 1e6)) {
    throw UsageError(fmt::format("--rate: must be a positive number or max, got '{}'", rate));
  }
  return factor;
}

/// Publishes one log on the network.
class LogReplay {
 public:
  LogReplay(const ReplayArguments& arguments,
            const config::ProgramOptions& options,
            pipeline::LogSource& source)
      : source_(source),
        participant_(options.network),
        reports_(participant_, {arguments.robot}),
        robot_(
            participant_,
            dds::RobotNames(arguments.robot),
            source.Peek()->T_odom_robot ? dds::OdometryUse::kPublished : dds::OdometryUse::kNone),
        window_(reports_, kScansOnTheirWay),
        progress_(arguments.network.verbosity.quiet ? pipeline::ProgressStyle::kNone
                                                    : pipeline::StyleFor(stderr)) {
    const std::optional<double> factor = FactorOf(arguments.rate);
    if (factor) pace_.emplace(*factor);
  }

  /// @returns false where nobody listens.
  bool WaitForListener(std::chrono::duration<double> timeout, const Interruption& interruption) {
    const auto until = Clock::now() + std::chrono::round<std::chrono::nanoseconds>(timeout);
    const Pose2 T_robot_laser = source_.Peek()->scan.geometry.T_robot_laser;
    while (!interruption.requested() && Clock::now() < until) {
      if (robot_.WaitForListener(T_robot_laser, 200ms)) {
        WaitForReporter();
        return true;
      }
    }
    return false;
  }

  /// @returns whether all of the log was published.
  bool Run(const Interruption& interruption) {
    while (std::optional<Observation> observation = source_.Next()) {
      while (pace_ && !pace_->WaitFor(observation->scan.stamp, 200ms)) {
        if (interruption.requested()) return false;
      }
      if (interruption.requested()) return false;
      if (!robot_.Publish(*observation)) ++late_;
      if (!pace_) KeepToAnswers(observation->scan.stamp);
      ShowProgress();
    }
    if (!pace_ && is_answered_) window_.WaitForAll(kPatience);
    robot_.WaitForAcknowledgments(kPatience);
    progress_.Clear();
    return true;
  }

  std::string Summary(std::chrono::duration<double> time) const {
    std::string text = fmt::format("published      {} scans in {:.1f} s\n",
                                   pipeline::WithThousands(source_.progress().scans),
                                   time.count());
    if (!pace_) {
      text += fmt::format("answered       {}, dropped by the service {}\n",
                          pipeline::WithThousands(window_.answered()),
                          window_.dropped());
    }
    if (late_ > 0) text += fmt::format("late           {} scans waited for a listener\n", late_);
    return text;
  }

 private:
  /// A service that hears the robot reports on it a moment later.
  void WaitForReporter() {
    const auto until = Clock::now() + 2s;
    while (!reports_.has_writer() && Clock::now() < until) reports_.Take(10ms);
    is_answered_ = reports_.has_writer();
    if (!pace_ && !is_answered_) {
      spdlog::warn("no service reports on the scans; paced by acknowledgments only");
    }
  }

  void KeepToAnswers(Timestamp stamp) {
    if (!is_answered_) {
      robot_.WaitForAcknowledgments(kPatience);
      return;
    }
    window_.NoteSent(stamp);
    if (!window_.WaitForRoom(kPatience)) {
      spdlog::warn("no answer for {} s; going on", std::chrono::seconds(kPatience).count());
    }
  }

  void ShowProgress() {
    progress_.Show([this](std::chrono::duration<double> elapsed) {
      return pipeline::ProgressLine("replay", source_.progress(), elapsed);
    });
  }

  pipeline::LogSource& source_;
  dds::Participant participant_;
  dds::MatchReportReader reports_;
  dds::RobotPublisher robot_;
  pipeline::AnswerWindow window_;
  std::optional<pipeline::Pace> pace_;
  pipeline::StatusLine progress_;
  bool is_answered_ = false;
  std::size_t late_ = 0;
};

ExitCode RunReplay(const ReplayArguments& arguments) {
  const NetworkSession session(arguments.network);
  FactorOf(arguments.rate);  // A wrong one is told before a log is read.
  pipeline::LogSource source(arguments.logs, LogOptionsOf(session.options().log));
  if (source.Peek() == nullptr) {
    throw UsageError("there is no scan in " + arguments.logs.front().string());
  }
  const Interruption interruption;
  LogReplay replay(arguments, session.options(), source);
  if (!replay.WaitForListener(std::chrono::duration<double>(arguments.wait_s), interruption)) {
    if (interruption.requested()) return ExitCode::kInterrupted;
    spdlog::error("nobody listens to {}; is 'qwsm serve' running in the same DDS domain?",
                  dds::RobotNames(arguments.robot).Topic(dds::kScanTopic));
    return ExitCode::kFailed;
  }
  const auto begin = Clock::now();
  const bool is_complete = replay.Run(interruption);
  if (!arguments.network.verbosity.quiet) fmt::print("{}", replay.Summary(Clock::now() - begin));
  return is_complete ? ExitCode::kDone : ExitCode::kInterrupted;
}

}  // namespace

Command AddReplayCommand(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("replay", "a recorded log as a robot on the network");
  auto arguments = std::make_shared<ReplayArguments>();
  parser->footer(
      "  qwsm replay intel.log.gz                   as /scan and /odom, at its own pace\n"
      "  qwsm replay intel.log.gz --robot robot1    as /robot1/scan and /robot1/odom\n"
      "  qwsm replay intel.log.gz --rate 10         ten times as fast\n"
      "  qwsm replay intel.log.gz --rate max        as fast as the service answers");
  parser->add_option("LOG", arguments->logs, "logs, parts of one recording; - is standard input")
      ->required()
      ->type_name("");
  parser->add_option("--robot", arguments->robot, "namespace of the robot; else none")
      ->type_name("NAME");
  parser->add_option("--rate", arguments->rate, "seconds of the log in a real one, or max")
      ->type_name("FACTOR")
      ->capture_default_str();
  parser->add_option("--wait", arguments->wait_s, "seconds to wait for somebody who listens")
      ->check(CLI::Range(0.0, 86400.0))
      ->type_name("S")
      ->capture_default_str();
  AddNetworkArguments(*parser, arguments->network, "not used");
  return {.parser = parser, .run = [arguments] { return RunReplay(*arguments); }};
}

}  // namespace qwsm::apps
