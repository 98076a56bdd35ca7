// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "service/view/http/beast/messages.hpp"
#include "service/view/http/beast/server.hpp"
#include "service/view/http/beast/socket.hpp"

namespace qwsm::view {

/// Says that nothing more will come.
inline void HangUp(beast::tcp_stream& stream, const std::shared_ptr<void>& /*owner*/) {
  error_code ignored;
  stream.socket().shutdown(tcp::socket::shutdown_send, ignored);
}

/// The same on an encrypted stream, which waits for the other side to say so, too.
template <class TlsStream>
void HangUp(TlsStream& stream, std::shared_ptr<void> owner) {
  beast::get_lowest_layer(stream).expires_after(kTimeToAsk);
  stream.async_shutdown([owner = std::move(owner)](error_code) {});
}

/// A connection that has not said yet that it wants to be a socket.
/// @tparam Stream that carries its bytes, plain or encrypted.
template <class Stream>
class Connection : public std::enable_shared_from_this<Connection<Stream>> {
 public:
  Connection(Stream stream, Counted place, Server& server)
      : server_(server), place_(std::move(place)), stream_(std::move(stream)) {}

  /// Hears what is asked.
  void Receive() {
    parser_.emplace();
    parser_->header_limit(kLongestHeader);
    parser_->body_limit(0);
    beast::get_lowest_layer(stream_).expires_after(kTimeToAsk);
    http::async_read(stream_,
                     buffer_,
                     *parser_,
                     [self = this->shared_from_this()](error_code error, std::size_t) {
                       if (!error) self->Take();
                     });
  }

  /// Refuses whatever is asked. @param heard its beginning, at most kLongestHeader.
  void RefuseAll(const beast::flat_buffer& heard, const WebAnswer& refusal) {
    buffer_.commit(asio::buffer_copy(buffer_.prepare(heard.size()), heard.data()));
    refusal_ = refusal;
    Receive();
  }

 private:
  void Take() {
    const HttpRequest& request = parser_->get();
    const WebRequest asked = ToWebRequest(request);
    if (refusal_) return Refuse(*refusal_);
    if (!websocket::is_upgrade(request)) return Answer(server_.handler.Answer(asked));
    if (const auto objection = server_.handler.Objection(asked)) return Refuse(*objection);
    const std::string_view protocol = ChooseProtocol(asked.protocols);
    if (protocol.empty()) {
      return Refuse({.status = 400,
                     .type = "text/plain",
                     .body = "the socket must offer foxglove.websocket.v1\n"});
    }
    if (server_.sockets >= server_.max_sockets) {
      return Refuse({.status = 503, .type = "text/plain", .body = "too many look on already\n"});
    }
    beast::get_lowest_layer(stream_).expires_never();
    std::make_shared<Socket<Stream>>(std::move(stream_), std::move(place_), server_)
        ->Start(request, protocol);
  }

  void Refuse(const WebAnswer& answer) {
    ++server_.refused;
    Answer(answer);
  }

  void Answer(const WebAnswer& answer) {
    response_ = ToHttpResponse(answer, parser_->get());
    beast::get_lowest_layer(stream_).expires_after(kTimeToTake);
    http::async_write(
        stream_, response_, [self = this->shared_from_this()](error_code error, std::size_t) {
          if (error) return;
          if (self->response_.keep_alive()) return self->Receive();
          HangUp(self->stream_, self);
        });
  }

  Server& server_;
  Counted place_;
  Stream stream_;
  beast::flat_buffer buffer_{kLongestHeader};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<WebAnswer> refusal_;
  HttpResponse response_;
};

}  // namespace qwsm::view
