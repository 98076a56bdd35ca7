// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/entities/middleware_messages.hpp"

#include <dds/ddsrt/log.h>
#include <fmt/format.h>

#include <utility>

namespace qwsm::dds {
namespace {

void PassOn(void* messages, const dds_log_data_t* data) {
  std::string text(data->message, data->size);
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  static_cast<MiddlewareMessages*>(messages)->Take(text);
}

}  // namespace

MiddlewareMessages::MiddlewareMessages(Sink sink, int per_second)
    : sink_(std::move(sink)), per_second_(per_second) {
  dds_set_log_sink(&PassOn, this);
}

MiddlewareMessages::~MiddlewareMessages() { dds_set_log_sink(nullptr, nullptr); }

void MiddlewareMessages::Take(const std::string& text) {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (now - second_ >= std::chrono::seconds(1)) {
    if (withheld_ > 0) sink_(fmt::format("DDS: {} more messages were left out", withheld_));
    second_ = now;
    said_ = 0;
    withheld_ = 0;
  }
  if (said_ < per_second_) {
    ++said_;
    sink_("DDS: " + text);
  } else {
    ++withheld_;
  }
}

}  // namespace qwsm::dds
