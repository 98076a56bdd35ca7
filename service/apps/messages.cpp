// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/messages.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <memory>
#include <string>

namespace qwsm::apps {

void StartMessages(const Verbosity& verbosity) {
  const auto console = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  console->set_pattern(std::string(program_invocation_short_name) + ": %v");
  if (verbosity.quiet) {
    console->set_level(spdlog::level::err);
  } else {
    console->set_level(verbosity.verbose ? spdlog::level::info : spdlog::level::warn);
  }
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("program", console));
}

void CopyMessagesTo(const std::filesystem::path& file) {
  const auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), true);
  sink->set_formatter(std::make_unique<spdlog::pattern_formatter>("%Y-%m-%dT%H:%M:%S.%eZ %l: %v",
                                                                  spdlog::pattern_time_type::utc));
  spdlog::default_logger()->sinks().push_back(sink);
  spdlog::default_logger()->flush_on(spdlog::level::info);
}

}  // namespace qwsm::apps
