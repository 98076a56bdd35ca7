// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace qwsm::test {

/// What carries a client's bytes to a server on this host and back.
class WebLine {
 public:
  WebLine() = default;
  WebLine(const WebLine&) = delete;
  WebLine& operator=(const WebLine&) = delete;
  virtual ~WebLine() = default;

  /// @returns false where the other side has gone.
  virtual bool Write(std::string_view bytes) = 0;
  /// Reads what is there, at most so much. @returns the number of bytes, 0 at the end, -1 where
  /// there is nothing yet.
  virtual ssize_t ReadNow(char* bytes, std::size_t most) = 0;
  /// Whether there may be something to read, waiting for it so long.
  virtual bool WaitFor(std::chrono::milliseconds period) = 0;
};

/// A line on which nothing is encrypted.
class PlainLine : public WebLine {
 public:
  /// @param receive_buffer_bytes of the kernel; 0: as it likes.
  explicit PlainLine(int port, int receive_buffer_bytes = 0)
      : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer_bytes > 0) {
      setsockopt(
          socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes, sizeof receive_buffer_bytes);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      close(socket_);
      throw std::runtime_error("nobody listens on port " + std::to_string(port));
    }
  }
  ~PlainLine() override { close(socket_); }

  bool Write(std::string_view bytes) override {
    while (!bytes.empty()) {
      const ssize_t sent = send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  ssize_t ReadNow(char* bytes, std::size_t most) override {
    return recv(socket_, bytes, most, MSG_DONTWAIT);
  }
  bool WaitFor(std::chrono::milliseconds period) override {
    pollfd waiting{.fd = socket_, .events = POLLIN, .revents = 0};
    return poll(&waiting, 1, static_cast<int>(period.count())) > 0;
  }

  int socket() const { return socket_; }

 private:
  int socket_;
};

}  // namespace qwsm::test
