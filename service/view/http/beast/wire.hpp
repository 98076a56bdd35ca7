// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace qwsm::view {

/// What carries the bytes of a connection, plain or encrypted: a stream as Asio and Beast
/// understand the word. It makes one type of all handlers, so that HTTP and sockets are compiled
/// once for both.
class Wire {
 public:
  using Plain = boost::beast::tcp_stream;
  using Encrypted = boost::beast::ssl_stream<Plain>;
  using executor_type = Plain::executor_type;
  using Done = std::function<void(boost::system::error_code, std::size_t)>;
  using Closed = std::function<void(boost::system::error_code)>;

  explicit Wire(Plain stream) : stream_(std::move(stream)) {}
  explicit Wire(Encrypted stream) : stream_(std::move(stream)) {}

  executor_type get_executor() { return next_layer().get_executor(); }
  Plain& next_layer();

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    Read(Listed<boost::asio::mutable_buffer>(buffers),
         Shared<Done>(std::forward<Handler>(handler)));
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    Write(Listed<boost::asio::const_buffer>(buffers), Shared<Done>(std::forward<Handler>(handler)));
  }

  /// Says that nothing more will come; an encrypted one waits for the other side to say so, too.
  void HangUp(Closed closed);

  /// How a socket ends (Beast finds it by its name).
  template <class Handler>
  friend void async_teardown(boost::beast::role_type role, Wire& wire, Handler&& handler) {
    wire.TearDown(role, Shared<Closed>(std::forward<Handler>(handler)));
  }

 private:
  template <class Buffer, class Buffers>
  static std::vector<Buffer> Listed(const Buffers& buffers) {
    return {boost::asio::buffer_sequence_begin(buffers), boost::asio::buffer_sequence_end(buffers)};
  }

  /// A handler, which may be one that can only be moved, as a function.
  template <class Function, class Handler>
  static Function Shared(Handler&& handler) {
    return [held = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler))](
               auto... result) { std::move (*held)(result...); };
  }

  void Read(const std::vector<boost::asio::mutable_buffer>& buffers, Done done);
  void Write(const std::vector<boost::asio::const_buffer>& buffers, Done done);
  void TearDown(boost::beast::role_type role, Closed closed);

  std::variant<Plain, Encrypted> stream_;
};

}  // namespace qwsm::view
