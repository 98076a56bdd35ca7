// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/http/beast/connection.hpp"

#include <cstddef>
#include <string_view>
#include <utility>

#include "service/view/http/beast/socket.hpp"

namespace qwsm::view {
namespace {

constexpr WebAnswer kToldToSendNothing{
    .status = 413, .type = "text/plain", .body = "only GET and HEAD, without a body\n"};

}  // namespace

Connection::Connection(Wire wire, Counted place, Server& server)
    : server_(server), place_(std::move(place)), wire_(std::move(wire)) {}

void Connection::Receive() {
  parser_.emplace();
  parser_->header_limit(kLongestHeader);
  parser_->body_limit(0);
  wire_.next_layer().expires_after(kTimeToAsk);
  http::async_read(
      wire_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
        if (!error) return self->Take();
        if (error == http::error::body_limit) self->Refuse(kToldToSendNothing);
      });
}

void Connection::RefuseAll(const beast::flat_buffer& heard, const WebAnswer& refusal) {
  buffer_.commit(asio::buffer_copy(buffer_.prepare(heard.size()), heard.data()));
  refusal_ = refusal;
  Receive();
}

void Connection::Take() {
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
  wire_.next_layer().expires_never();
  std::make_shared<Socket>(std::move(wire_), std::move(place_), server_)->Start(request, protocol);
}

void Connection::Refuse(const WebAnswer& answer) {
  ++server_.refused;
  Answer(answer);
}

void Connection::Answer(const WebAnswer& answer) {
  response_ = ToHttpResponse(answer, parser_->get());
  wire_.next_layer().expires_after(kTimeToTake);
  http::async_write(wire_, response_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return;
    if (self->response_.keep_alive()) return self->Receive();
    self->wire_.HangUp([self](error_code) {});
  });
}

}  // namespace qwsm::view
