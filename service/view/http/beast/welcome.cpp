// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/http/beast/welcome.hpp"

#include "service/view/http/beast/connection.hpp"

namespace qwsm::view {
namespace {

constexpr WebAnswer kToldToEncrypt{
    .status = 400, .type = "text/plain", .body = "this port is encrypted: ask for https://...\n"};

/// A connection that has not agreed on keys yet. All of that has the time that asking has.
class Greeting : public std::enable_shared_from_this<Greeting> {
 public:
  Greeting(tcp::socket socket, asio::ssl::context& identity, Server& server)
      : server_(server), place_(server.connections), stream_(std::move(socket), identity) {}

  void Start() {
    beast::get_lowest_layer(stream_).expires_after(kTimeToAsk);
    beast::async_detect_ssl(stream_.next_layer(),
                            heard_,
                            [self = shared_from_this()](error_code error, bool is_encrypted) {
                              if (error) return;
                              is_encrypted ? self->AgreeOnKeys() : self->Refuse();
                            });
  }

 private:
  void AgreeOnKeys() {
    stream_.async_handshake(asio::ssl::stream_base::server,
                            heard_.data(),
                            [self = shared_from_this()](error_code error, std::size_t) {
                              error ? self->Count() : self->Hear();
                            });
  }
  void Count() { ++server_.refused; }
  void Hear() {
    std::make_shared<Connection>(Wire(std::move(stream_)), std::move(place_), server_)->Receive();
  }
  void Refuse() {
    std::make_shared<Connection>(Wire(std::move(stream_.next_layer())), std::move(place_), server_)
        ->RefuseAll(heard_, kToldToEncrypt);
  }

  Server& server_;
  Counted place_;
  Wire::Encrypted stream_;
  beast::flat_buffer heard_{kLongestHeader};
};

}  // namespace

void WelcomePlain(tcp::socket socket, Server& server) {
  std::make_shared<Connection>(
      Wire(Wire::Plain(std::move(socket))), Counted(server.connections), server)
      ->Receive();
}

void WelcomeEncrypted(tcp::socket socket, asio::ssl::context& identity, Server& server) {
  std::make_shared<Greeting>(std::move(socket), identity, server)->Start();
}

}  // namespace qwsm::view
