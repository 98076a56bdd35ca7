// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/http/beast/socket.hpp"

#include <array>
#include <chrono>
#include <string>
#include <utility>

namespace qwsm::view {

Socket::Socket(Wire wire, Counted connection, Server& server)
    : server_(server),
      connection_(std::move(connection)),
      socket_(server.sockets),
      stream_(std::move(wire)),
      kick_(server.kicks.insert(server.kicks.end(), [] {})),
      pause_(stream_.get_executor()) {}

void Socket::Start(const HttpRequest& request, std::string_view protocol) {
  stream_.set_option(websocket::stream_base::timeout{
      .handshake_timeout = kTimeToAsk, .idle_timeout = kSilence, .keep_alive_pings = true});
  stream_.set_option(websocket::stream_base::decorator(
      [name = std::string(protocol)](websocket::response_type& response) {
        response.set(http::field::sec_websocket_protocol, name);
      }));
  stream_.read_message_max(kLongestMessage);
  stream_.auto_fragment(false);
  stream_.async_accept(request, [self = shared_from_this()](error_code error) {
    if (!error) self->Open();
  });
}

void Socket::Open() {
  client_ = server_.handler.Open();
  // The list holds no socket alive: it is their own end that takes them out.
  *kick_ = [this] { Send(); };
  Receive();
  Send();
}

void Socket::Receive() {
  stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
    if (!error) self->Take();
  });
}

void Socket::Take() {
  const std::string text = beast::buffers_to_string(buffer_.data());
  buffer_.consume(buffer_.size());
  stream_.got_text() ? client_->TakeText(text) : client_->TakeBytes(text);
  Send();
  const auto now = Clock::now();
  if (now - second_ >= std::chrono::seconds(1)) {
    second_ = now;
    heard_ = 0;
  }
  if (++heard_ < kMessagesPerSecond) return Receive();
  pause_.expires_at(second_ + std::chrono::seconds(1));
  pause_.async_wait([self = shared_from_this()](error_code) { self->Receive(); });
}

void Socket::Send() {
  if (is_sending_ || !stream_.is_open()) return;
  auto next = client_->Next(Clock::now());
  if (!next) return;
  is_sending_ = true;
  outgoing_ = std::move(*next);
  stream_.text(outgoing_.is_text);
  const std::array buffers{
      asio::const_buffer(outgoing_.head.data(), outgoing_.head.size()),
      asio::const_buffer(outgoing_.sample.bytes.data(), outgoing_.sample.bytes.size())};
  stream_.async_write(buffers, [self = shared_from_this()](error_code error, std::size_t) {
    self->outgoing_ = {};
    self->is_sending_ = false;
    if (!error) self->Send();
  });
}

}  // namespace qwsm::view
