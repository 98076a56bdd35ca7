// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <string>

#include "service/apps/command.hpp"
#include "service/apps/output.hpp"
#include "service/dds/wire/wire_kind.hpp"
#include "service/pipeline/network/network_replay.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {

/// Arguments of all commands that replay a record on the network.
struct ReplayArguments {
  std::string robot;
  std::string rate = "1";
  double wait_s = 10.0;
};

void AddReplayArguments(CLI::App& parser, ReplayArguments& arguments);

/// Options of a replay from its arguments. @throws UsageError where --rate makes no sense.
pipeline::ReplayOptions ReplayOptionsOf(const ReplayArguments& arguments,
                                        const Verbosity& verbosity);

/// Replays all of a source on the network.
/// @param server who could listen, such as `qwsm serve`.
/// @pre the source has a scan.
template <class Kind, class Source>
ExitCode Replay(Source& source,
                const ReplayArguments& arguments,
                const dds::NetworkOptions& network,
                const Verbosity& verbosity,
                const std::string& server) {
  const pipeline::Interruption interruption;
  pipeline::NetworkReplay<Kind, Source> replay(
      network, ReplayOptionsOf(arguments, verbosity), source);
  const typename Kind::Pose T_robot_sensor = dds::OnWire<Kind>::Mounting(source.Peek()->scan);
  if (!replay.WaitForListener(
          T_robot_sensor, std::chrono::duration<double>(arguments.wait_s), interruption)) {
    if (interruption.requested()) return ExitCode::kInterrupted;
    messages::Error("nobody listens to {}; is '{}' running in the same DDS domain?",
                    dds::RobotNames(arguments.robot).Topic(dds::OnWire<Kind>::kScanTopic),
                    server);
    return ExitCode::kFailed;
  }
  const auto begin = std::chrono::steady_clock::now();
  const bool is_complete = replay.Run(interruption);
  const auto time = std::chrono::steady_clock::now() - begin;
  if (!verbosity.quiet) Print("{}", replay.Summary(time));
  if (!is_complete) return ExitCode::kInterrupted;
  if (!replay.is_ignored()) return ExitCode::kDone;
  messages::Error(
      "no scan was answered: a service takes none that is older than what it had of the same "
      "robot, as in a second replay; start '{}' anew, or give another --robot",
      server);
  return ExitCode::kFailed;
}

}  // namespace qwsm::apps
