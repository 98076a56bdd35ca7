// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>

#include "service/view/http/beast/server.hpp"

namespace qwsm::view {

/// Hears who has connected. @param server outlives the connection, here and below.
void WelcomePlain(boost::asio::ip::tcp::socket socket, Server& server);

/// Agrees on keys with who has connected, and hears it. Who does not encrypt is told to.
/// @param identity outlives the connection.
void WelcomeEncrypted(boost::asio::ip::tcp::socket socket,
                      boost::asio::ssl::context& identity,
                      Server& server);

}  // namespace qwsm::view
