// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/network.hpp"
#include "service/apps/number_arguments.hpp"
#include "service/apps/output.hpp"
#include "service/dds/robot/match_report_reader.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/text/json.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/team/sinks/team_status.hpp"

namespace qwsm::apps {
namespace {

using namespace std::chrono_literals;

struct EchoArguments {
  std::vector<std::string> robots;
  std::optional<std::size_t> count;
  std::optional<double> duration_s;
  std::string format = "text";
  NetworkArguments network;
};

double Milliseconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

std::string TextOf(const dds::MatchReport& report) {
  const Pose2& pose = report.map_robot.T_a_b;
  return fmt::format(
      "{:<10} {:.6f}  {:9.3f} m {:9.3f} m {:8.2f} deg  {:<13} {:3.0f} % of {:4} pairs  {:.2f} "
      "ms{}\n",
      team::DisplayName(report.robot),
      Seconds(report.stamp),
      pose.x_m,
      pose.y_m,
      RadiansToDegrees(pose.theta_rad),
      Name(report.status),
      100.0 * report.overlap,
      report.pairs,
      Milliseconds(report.latency),
      report.dropped > 0 ? fmt::format("  dropped {}", report.dropped) : "");
}

std::string JsonOf(const dds::MatchReport& report) {
  const Pose2& pose = report.map_robot.T_a_b;
  pipeline::Json json;
  json["robot"] = report.robot;
  json["stamp_s"] = Seconds(report.stamp);
  json["x_m"] = pose.x_m;
  json["y_m"] = pose.y_m;
  json["theta_rad"] = pose.theta_rad;
  json["status"] = Name(report.status);
  json["reason"] = report.reason;
  json["relevant"] = report.relevant;
  json["pairs"] = report.pairs;
  json["overlap"] = report.overlap;
  json["residual_mm"] = report.mean_residual_m * 1e3;
  json["trace"] = report.position_trace_m2;
  json["ms"] = Milliseconds(report.duration);
  json["latency_ms"] = Milliseconds(report.latency);
  json["scans"] = report.scans;
  json["dropped"] = report.dropped;
  return json.Line();
}

std::string LineOf(const dds::MatchReport& report, const EchoArguments& arguments) {
  if (arguments.network.verbosity.json) return JsonOf(report);
  if (arguments.format == "text") return TextOf(report);
  std::ostringstream line;
  io::WriteTumLine(line, {.stamp = report.stamp, .T_map_robot = report.map_robot.T_a_b});
  return line.str();
}

ExitCode RunEcho(const EchoArguments& arguments) {
  const NetworkSession session(arguments.network);
  const dds::Participant participant(session.options().network);
  dds::MatchReportReader reports(participant, arguments.robots);
  const pipeline::Interruption interruption(pipeline::Interruption::kListensNoMore,
                                            pipeline::Interruption::WithoutReaders::kEnds);
  messages::Info("listening");
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  std::size_t shown = 0;
  while (!interruption.requested()) {
    if (arguments.duration_s &&
        Clock::now() - begin > std::chrono::duration<double>(*arguments.duration_s)) {
      break;
    }
    for (const dds::MatchReport& report : reports.Take(100ms)) {
      PrintText(LineOf(report, arguments));
      if (++shown == arguments.count) return ExitCode::kDone;
    }
  }
  const bool is_short = arguments.count.has_value() && !interruption.requested();
  return is_short ? ExitCode::kFailed : ExitCode::kDone;
}

}  // namespace

Command AddEchoCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "echo", "poses as the service finds them");
  auto arguments = std::make_shared<EchoArguments>();
  parser->footer(
      "  qwsm echo                             of all robots, until Ctrl-C\n"
      "  qwsm echo robot1 --count 1            of one robot, once\n"
      "  qwsm echo robot1 --to tum > live.tum  as a trajectory");
  parser->add_option("ROBOT", arguments->robots, "namespaces of robots; else all")->type_name("");
  parser->add_option("--count", arguments->count, "stop after so many")
      ->check(NumberBetween(1.0, kMostCounted))
      ->type_name("N");
  parser->add_option("--duration", arguments->duration_s, "stop after so many seconds")
      ->check(NumberBetween(0.0, kLongest_s))
      ->type_name("S");
  parser->add_option("--to", arguments->format, "text or tum")
      ->check(CLI::IsMember({"text", "tum"}))
      ->type_name("FORM")
      ->capture_default_str();
  AddNetworkArguments(*parser, arguments->network, "one JSON object per report");
  return {.parser = parser, .run = [arguments] { return RunEcho(*arguments); }};
}

}  // namespace qwsm::apps
