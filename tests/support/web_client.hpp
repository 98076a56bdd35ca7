// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tests/support/web_line.hpp"

namespace qwsm::test {

/// A connection to a web server on this host that says whatever a test wants, also nonsense.
class WebClient {
 public:
  /// @param receive_buffer_bytes of the kernel; 0: as it likes.
  explicit WebClient(int port, int receive_buffer_bytes = 0)
      : WebClient(std::make_unique<PlainLine>(port, receive_buffer_bytes)) {}
  explicit WebClient(std::unique_ptr<WebLine> line) : line_(std::move(line)) {}

  /// Sends bytes as they are. @returns false where the other side has gone.
  bool Send(std::string_view bytes) const { return line_->Write(bytes); }
  /// Whether the server has hung up, waiting for that so long; what it says meanwhile is dropped.
  bool IsClosedWithin(std::chrono::milliseconds period) {
    const auto until = std::chrono::steady_clock::now() + period;
    while (std::chrono::steady_clock::now() < until) {
      if (!Fill(until)) return is_closed_;
      received_.clear();
    }
    return is_closed_;
  }

  /// Asks for a page. @param more lines of the header, each with its end.
  std::string Get(const std::string& target, const std::string& more = {}) {
    return Ask("GET " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + more +
               "\r\n");
  }
  /// Says something. @returns all that is answered until the server hangs up.
  std::string Ask(std::string_view request) {
    Send(request);
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (Fill(until)) continue;
    return std::exchange(received_, {});
  }
  /// Asks to be a socket. @returns the head of the answer.
  std::string Upgrade(const std::string& target = "/ws",
                      const std::string& host = "localhost",
                      const std::string& more = {},
                      const std::string& protocol = "foxglove.websocket.v1") {
    Send("GET " + target + " HTTP/1.1\r\nHost: " + host +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
         (protocol.empty() ? "" : "Sec-WebSocket-Protocol: " + protocol + "\r\n") + more + "\r\n");
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    std::size_t end = std::string::npos;
    while ((end = received_.find("\r\n\r\n")) == std::string::npos) {
      if (!Fill(until)) return std::exchange(received_, {});
    }
    std::string head = received_.substr(0, end);
    received_.erase(0, end + 4);
    return head;
  }

  enum Opcode : std::uint8_t { kText = 1, kBinary = 2, kClose = 8 };

  /// Sends a whole message, masked with zeros.
  bool SendFrame(Opcode opcode, std::string_view payload) const {
    std::string frame(1, static_cast<char>(0x80 | opcode));
    if (payload.size() < 126) {
      frame += static_cast<char>(0x80 | payload.size());
    } else {
      frame += static_cast<char>(0x80 | 126);
      frame += static_cast<char>(payload.size() >> 8U);
      frame += static_cast<char>(payload.size());
    }
    return Send(frame + std::string(4, '\0') + std::string(payload));
  }

  struct Frame {
    int opcode = 0;
    std::string payload;
  };
  /// The next message of the server; nothing where none comes in time.
  std::optional<Frame> Receive(std::chrono::milliseconds timeout = std::chrono::seconds(10)) {
    const auto until = std::chrono::steady_clock::now() + timeout;
    while (true) {
      if (auto frame = TakeFrame()) return frame;
      if (!Fill(until)) return std::nullopt;
    }
  }
  /// The next message with this in it.
  std::optional<Frame> ReceiveWith(std::string_view text) {
    while (auto frame = Receive()) {
      if (frame->payload.find(text) != std::string::npos) return frame;
    }
    return std::nullopt;
  }

  /// The next message of those that have been read.
  std::optional<Frame> TakeFrame() {
    if (received_.size() < 2) return std::nullopt;
    std::uint64_t size = Number(1, 1);
    const std::size_t wide = size == 126 ? 2 : size == 127 ? 8 : 0;
    if (received_.size() < 2 + wide) return std::nullopt;
    if (wide > 0) size = Number(2, wide);
    if (received_.size() < 2 + wide + size) return std::nullopt;
    Frame frame{.opcode = static_cast<int>(Number(0, 1) & 15U),
                .payload = received_.substr(2 + wide, size)};
    received_.erase(0, 2 + wide + size);
    return frame;
  }

  /// Reads what is there, but no more than so much, without waiting.
  void ReadAtMost(std::size_t bytes) {
    std::string buffer(bytes, '\0');
    const ssize_t got = line_->ReadNow(buffer.data(), bytes);
    if (got > 0) received_.append(buffer, 0, static_cast<std::size_t>(got));
  }

 private:
  std::uint64_t Number(std::size_t at, std::size_t size) const {
    std::uint64_t number = 0;
    for (std::size_t i = at; i < at + size; ++i) {
      number = (number << 8U) | static_cast<std::uint8_t>(received_[i]);
    }
    return number;
  }

  /// Waits for bytes. @returns false where none came in time, or none will ever come.
  bool Fill(std::chrono::steady_clock::time_point until) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    if (left.count() <= 0 || !line_->WaitFor(left)) return false;
    char buffer[65536];
    const ssize_t got = line_->ReadNow(buffer, sizeof buffer);
    if (got < 0 && errno == EAGAIN) return true;
    is_closed_ = got <= 0;
    if (got > 0) received_.append(buffer, static_cast<std::size_t>(got));
    return got > 0;
  }

  std::unique_ptr<WebLine> line_;
  bool is_closed_ = false;
  std::string received_;
};

}  // namespace qwsm::test
