// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/http/beast/connection.hpp"
#include "service/view/http/beast/welcome.hpp"

namespace qwsm::view {

using PlainConnection = Connection<beast::tcp_stream>;

void WelcomePlain(tcp::socket socket, Server& server) {
  std::make_shared<PlainConnection>(
      beast::tcp_stream(std::move(socket)), Counted(server.connections), server)
      ->Receive();
}

void RefusePlain(beast::tcp_stream stream,
                 const beast::flat_buffer& heard,
                 const WebAnswer& refusal,
                 Server& server) {
  std::make_shared<PlainConnection>(std::move(stream), Counted(server.connections), server)
      ->RefuseAll(heard, refusal);
}

}  // namespace qwsm::view
