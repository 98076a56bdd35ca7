// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/messages.hpp"

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <memory>
#include <string>

#include "service/pipeline/text/json.hpp"

namespace qwsm::apps {
namespace {

constexpr const char* kTime = "%Y-%m-%dT%H:%M:%S.%eZ";

class JsonFormatter final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
    spdlog::memory_buf_t time;
    time_.format(message, time);
    pipeline::Json json;
    json["time"] = fmt::to_string(time);
    const auto level = spdlog::level::to_string_view(message.level);
    json["level"] = std::string(level.data(), level.size());
    json["message"] = std::string(message.payload.data(), message.payload.size());
    const std::string text = json.Line();
    line.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<JsonFormatter>();
  }

 private:
  spdlog::pattern_formatter time_{kTime, spdlog::pattern_time_type::utc, ""};
};

}  // namespace

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

void WriteMessagesAsJson() {
  for (const spdlog::sink_ptr& sink : spdlog::default_logger()->sinks()) {
    sink->set_formatter(std::make_unique<JsonFormatter>());
  }
}

void CopyMessagesTo(const std::filesystem::path& file) {
  const auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), true);
  sink->set_formatter(std::make_unique<spdlog::pattern_formatter>(std::string(kTime) + " %l: %v",
                                                                  spdlog::pattern_time_type::utc));
  spdlog::default_logger()->sinks().push_back(sink);
  spdlog::default_logger()->flush_on(spdlog::level::info);
}

}  // namespace qwsm::apps
