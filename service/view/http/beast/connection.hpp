// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "service/view/http/beast/messages.hpp"
#include "service/view/http/beast/server.hpp"
#include "service/view/http/beast/wire.hpp"

namespace qwsm::view {

/// A connection that has not said yet that it wants to be a socket.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Wire wire, Counted place, Server& server);

  /// Hears what is asked.
  void Receive();

  /// Refuses whatever is asked. @param heard its beginning, at most kLongestHeader.
  void RefuseAll(const beast::flat_buffer& heard, const WebAnswer& refusal);

 private:
  void Take();
  void Refuse(const WebAnswer& answer);
  void Answer(const WebAnswer& answer);

  Server& server_;
  Counted place_;
  Wire wire_;
  beast::flat_buffer buffer_{kLongestHeader};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<WebAnswer> refusal_;
  HttpResponse response_;
};

}  // namespace qwsm::view
