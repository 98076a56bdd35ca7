// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/websocket.hpp>
#include <cstddef>
#include <list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "service/view/http/beast/messages.hpp"
#include "service/view/http/beast/server.hpp"

namespace qwsm::view {

namespace websocket = boost::beast::websocket;

/// A socket of one who looks on. @tparam Stream that carries its bytes, plain or encrypted.
template <class Stream>
class Socket : public std::enable_shared_from_this<Socket<Stream>> {
 public:
  Socket(Stream stream, Counted connection, Server& server)
      : server_(server),
        connection_(std::move(connection)),
        socket_(server.sockets),
        stream_(std::move(stream)),
        kick_(server.kicks.insert(server.kicks.end(), [] {})),
        pause_(stream_.get_executor()) {}
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() { server_.kicks.erase(kick_); }

  /// Grants a request to be a socket that speaks this protocol.
  void Start(const HttpRequest& request, std::string_view protocol) {
    stream_.set_option(websocket::stream_base::timeout{
        .handshake_timeout = kTimeToAsk, .idle_timeout = kSilence, .keep_alive_pings = true});
    stream_.set_option(websocket::stream_base::decorator(
        [name = std::string(protocol)](websocket::response_type& response) {
          response.set(http::field::sec_websocket_protocol, name);
        }));
    stream_.read_message_max(kLongestMessage);
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = this->shared_from_this()](error_code error) {
      if (!error) self->Open();
    });
  }

 private:
  static constexpr std::size_t kLongestMessage = 64 * 1024;
  static constexpr int kMessagesPerSecond = 200;

  void Open() {
    client_ = server_.handler.Open();
    // The list holds no socket alive: it is their own end that takes them out.
    *kick_ = [this] { Send(); };
    Receive();
    Send();
  }

  void Receive() {
    stream_.async_read(buffer_, [self = this->shared_from_this()](error_code error, std::size_t) {
      if (!error) self->Take();
    });
  }

  void Take() {
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
    pause_.async_wait([self = this->shared_from_this()](error_code) { self->Receive(); });
  }

  void Send() {
    if (is_sending_ || !stream_.is_open()) return;
    auto next = client_->Next(Clock::now());
    if (!next) return;
    is_sending_ = true;
    outgoing_ = std::move(*next);
    stream_.text(outgoing_.is_text);
    const std::array buffers{
        asio::const_buffer(outgoing_.head.data(), outgoing_.head.size()),
        asio::const_buffer(outgoing_.sample.bytes.data(), outgoing_.sample.bytes.size())};
    stream_.async_write(buffers, [self = this->shared_from_this()](error_code error, std::size_t) {
      self->outgoing_ = {};
      self->is_sending_ = false;
      if (!error) self->Send();
    });
  }

  Server& server_;
  Counted connection_;
  Counted socket_;
  websocket::stream<Stream> stream_;
  std::unique_ptr<Client> client_;
  std::list<std::function<void()>>::iterator kick_;
  beast::flat_buffer buffer_{kLongestMessage};
  Outgoing outgoing_;
  bool is_sending_ = false;
  asio::steady_timer pause_;
  Clock::time_point second_{};
  int heard_ = 0;
};

}  // namespace qwsm::view
