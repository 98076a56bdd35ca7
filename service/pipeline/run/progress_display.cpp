// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/progress_display.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace qwsm::pipeline {
namespace {

using std::chrono::milliseconds;

// Fast enough to look alive, slow enough not to cost anything.
constexpr milliseconds kBarPeriod(100);
constexpr milliseconds kLinePeriod(5000);
constexpr std::string_view kEraseLine = "\r\x1b[K";

void Write(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

std::string WithThousands(std::size_t number) {
  std::string text = fmt::format("{}", number);
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, 1, ' ');
  return text;
}

std::string ProgressLine(const std::string& task,
                         const SourceProgress& progress,
                         std::chrono::duration<double> elapsed) {
  std::string line = task;
  const auto scans = static_cast<double>(progress.scans);
  const bool has_share = progress.share.value_or(0.0) > 0.0;
  std::string total;
  if (has_share) {
    line += fmt::format("  {:2.0f} %", std::floor(*progress.share * 100.0));
    const auto expected = static_cast<std::size_t>(std::llround(scans / *progress.share));
    total = fmt::format("/{}", WithThousands(expected));
  }
  line += fmt::format("  {}{} scans", WithThousands(progress.scans), total);
  if (elapsed.count() > 0.0) line += fmt::format("  {:.0f} scan/s", scans / elapsed.count());
  if (progress.simulated) line += "  " + SimulatedTimeText(*progress.simulated, elapsed);
  if (has_share) {
    line += "  ETA " + MinutesAndSeconds(elapsed.count() * (1.0 / *progress.share - 1.0));
  }
  return line + fmt::format("  dropped {}", progress.dropped);
}

std::string SimulatedTimeText(std::chrono::duration<double> simulated,
                              std::chrono::duration<double> elapsed) {
  std::string text = fmt::format("{:.0f} s simulated", simulated.count());
  if (elapsed.count() > 0.0) text += fmt::format("  {:.3g} x real time", simulated / elapsed);
  return text;
}

ProgressStyle StyleFor(std::FILE* stream) {
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  return isatty(fileno(stream)) != 0 && !is_dumb ? ProgressStyle::kBar : ProgressStyle::kLines;
}

std::string MinutesAndSeconds(double duration_s) {
  const long long seconds = std::llround(duration_s);
  if (seconds >= 3600) {
    return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
  }
  return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
}

StatusLine::StatusLine(ProgressStyle style)
    : style_(style),
      begin_(Clock::now()),
      next_(begin_ + (style == ProgressStyle::kBar ? kBarPeriod : kLinePeriod)) {}

void StatusLine::Show(
    const std::function<std::string(std::chrono::duration<double> elapsed)>& text) {
  if (style_ == ProgressStyle::kNone) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  const std::string line = text(now - begin_);
  const bool is_bar = style_ == ProgressStyle::kBar;
  Write(is_bar ? std::string(kEraseLine) + line : line + "\n");
  shown_ = is_bar;
  next_ = now + (is_bar ? kBarPeriod : kLinePeriod);
}

void StatusLine::Clear() {
  if (shown_) Write(kEraseLine);
  shown_ = false;
}

ProgressDisplay::ProgressDisplay(std::string task, const ScanSource& source, ProgressStyle style)
    : task_(std::move(task)), source_(source), line_(style) {}

void ProgressDisplay::Take(const TimedStep&) {
  line_.Show([this](std::chrono::duration<double> elapsed) {
    return ProgressLine(task_, source_.progress(), elapsed);
  });
}

}  // namespace qwsm::pipeline
