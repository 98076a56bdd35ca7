// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/http/beast/wire.hpp"

#include <boost/beast/websocket/ssl.hpp>

#include "service/view/http/beast/server.hpp"

namespace qwsm::view {

namespace beast = boost::beast;

Wire::Plain& Wire::next_layer() {
  auto* encrypted = std::get_if<Encrypted>(&stream_);
  return encrypted != nullptr ? encrypted->next_layer() : std::get<Plain>(stream_);
}

void Wire::Read(const std::vector<boost::asio::mutable_buffer>& buffers, Done done) {
  std::visit([&](auto& stream) { stream.async_read_some(buffers, std::move(done)); }, stream_);
}

void Wire::Write(const std::vector<boost::asio::const_buffer>& buffers, Done done) {
  std::visit([&](auto& stream) { stream.async_write_some(buffers, std::move(done)); }, stream_);
}

void Wire::TearDown(beast::role_type role, Closed closed) {
  std::visit([&](auto& stream) { async_teardown(role, stream, std::move(closed)); }, stream_);
}

void Wire::HangUp(Closed closed) {
  if (auto* encrypted = std::get_if<Encrypted>(&stream_)) {
    next_layer().expires_after(kTimeToAsk);
    return encrypted->async_shutdown(std::move(closed));
  }
  boost::system::error_code error;
  next_layer().socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, error);
  closed(error);
}

}  // namespace qwsm::view
