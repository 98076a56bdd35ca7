// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/websocket.hpp>
#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <string_view>

#include "service/view/http/beast/messages.hpp"
#include "service/view/http/beast/server.hpp"
#include "service/view/http/beast/wire.hpp"

namespace qwsm::view {

namespace websocket = boost::beast::websocket;

/// A socket of one who looks on.
class Socket : public std::enable_shared_from_this<Socket> {
 public:
  Socket(Wire wire, Counted connection, Server& server);
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() { server_.kicks.erase(kick_); }

  /// Grants a request to be a socket that speaks this protocol.
  void Start(const HttpRequest& request, std::string_view protocol);

 private:
  static constexpr std::size_t kLongestMessage = 64 * 1024;
  static constexpr int kMessagesPerSecond = 200;

  void Open();
  void Receive();
  void Take();
  void Send();

  Server& server_;
  Counted connection_;
  Counted socket_;
  websocket::stream<Wire> stream_;
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
