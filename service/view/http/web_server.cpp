// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Boost.Beast is seen here only: it takes the compiler half a minute.
#include "service/view/http/web_server.hpp"

#include <fmt/format.h>
#include <netinet/tcp.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <list>
#include <thread>
#include <utility>

namespace qwsm::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using beast::error_code;

constexpr int kNicenessOfServer = 5;
constexpr std::chrono::seconds kTimeToAsk{5};
constexpr std::chrono::seconds kTimeToTake{20};
constexpr std::chrono::seconds kSilence{20};  // Of a socket; half of it, and it is pinged.
constexpr std::chrono::milliseconds kTick{100};
constexpr std::uint32_t kLongestHeader = 8 * 1024;
constexpr std::size_t kLongestMessage = 64 * 1024;
constexpr int kMessagesPerSecond = 200;
// Connections that have not become sockets: of one browser, six.
constexpr std::size_t kMostPlainConnections = 64;
// What waits in the kernel cannot be overtaken by what is newer.
constexpr int kUnsentBytes = 4 * 1024;

/// What all connections share. Used by the server's thread, but for the counts.
struct Server {
  WebHandler& handler;
  std::size_t max_sockets;
  std::atomic<std::size_t> sockets = 0;
  std::atomic<std::size_t> connections = 0;
  std::atomic<std::size_t> refused = 0;
  std::list<std::function<void()>> kicks{};  // One of each socket: look for something to send.
};

std::string_view ToView(beast::string_view text) { return {text.data(), text.size()}; }

template <class Fields>
WebRequest ToWebRequest(const Fields& request) {
  return {.is_get = request.method() == http::verb::get,
          .target = ToView(request.target()),
          .host = ToView(request[http::field::host]),
          .origin = ToView(request[http::field::origin]),
          .protocols = ToView(request[http::field::sec_websocket_protocol])};
}

/// The first protocol of ours that the client offers; nothing where there is none.
std::string_view ChooseProtocol(beast::string_view offered) {
  for (const auto& name : http::token_list(offered)) {
    const auto* const ours = std::ranges::find(kProtocolNames, ToView(name));
    if (ours != std::end(kProtocolNames)) return *ours;
  }
  return {};
}

/// A socket of one who looks on.
class Socket : public std::enable_shared_from_this<Socket> {
 public:
  using Stream = websocket::stream<beast::tcp_stream>;

  Socket(beast::tcp_stream stream, Server& server)
      : server_(server), stream_(std::move(stream)), pause_(stream_.get_executor()) {
    ++server_.sockets;
    kick_ = server_.kicks.insert(server_.kicks.end(), [] {});
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() {
    --server_.sockets;
    --server_.connections;
    server_.kicks.erase(kick_);
  }

  template <class Request>
  void Start(const Request& request, std::string_view protocol) {
    stream_.set_option(websocket::stream_base::timeout{
        .handshake_timeout = kTimeToAsk, .idle_timeout = kSilence, .keep_alive_pings = true});
    stream_.set_option(websocket::stream_base::decorator(
        [name = std::string(protocol)](websocket::response_type& response) {
          response.set(http::field::sec_websocket_protocol, name);
        }));
    stream_.read_message_max(kLongestMessage);
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (!error) self->Open();
    });
  }

 private:
  void Open() {
    client_ = server_.handler.Open();
    // The list holds no socket alive: it is their own end that takes them out.
    *kick_ = [this] { Send(); };
    Receive();
    Send();
  }

  void Receive() {
    stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
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
    pause_.async_wait([self = shared_from_this()](error_code) { self->Receive(); });
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
    stream_.async_write(buffers, [self = shared_from_this()](error_code error, std::size_t) {
      self->outgoing_ = {};
      self->is_sending_ = false;
      if (!error) self->Send();
    });
  }

  Server& server_;
  Stream stream_;
  std::unique_ptr<Client> client_;
  std::list<std::function<void()>>::iterator kick_;
  beast::flat_buffer buffer_{kLongestMessage};
  Outgoing outgoing_;
  bool is_sending_ = false;
  asio::steady_timer pause_;
  Clock::time_point second_{};
  int heard_ = 0;
};

/// A connection that has not said yet that it wants to be a socket.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Server& server) : server_(server), stream_(std::move(socket)) {
    ++server_.connections;
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    if (!is_upgraded_) --server_.connections;
  }

  void Receive() {
    parser_.emplace();
    parser_->header_limit(kLongestHeader);
    parser_->body_limit(0);
    stream_.expires_after(kTimeToAsk);
    http::async_read(
        stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
          if (!error) self->Take();
        });
  }

 private:
  using Response = http::response<http::span_body<const char>>;

  void Take() {
    const auto& request = parser_->get();
    const WebRequest asked = ToWebRequest(request);
    if (!websocket::is_upgrade(request)) return Answer(server_.handler.Answer(asked));
    if (const auto objection = server_.handler.Objection(asked)) return Refuse(*objection);
    const std::string_view protocol = ChooseProtocol(request[http::field::sec_websocket_protocol]);
    if (protocol.empty()) {
      return Refuse({.status = 400,
                     .type = "text/plain",
                     .body = "the socket must offer foxglove.websocket.v1\n"});
    }
    if (server_.sockets >= server_.max_sockets) {
      return Refuse({.status = 503, .type = "text/plain", .body = "too many look on already\n"});
    }
    is_upgraded_ = true;
    stream_.expires_never();
    std::make_shared<Socket>(std::move(stream_), server_)->Start(request, protocol);
  }

  void Refuse(const WebAnswer& answer) {
    ++server_.refused;
    Answer(answer);
  }

  void Answer(const WebAnswer& answer) {
    const auto& request = parser_->get();
    response_ = {};
    response_.version(request.version());
    response_.result(static_cast<unsigned>(answer.status));
    response_.set(http::field::content_type, std::string(answer.type));
    response_.set(http::field::cache_control, "no-cache");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Content-Security-Policy",
                  "default-src 'self'; connect-src 'self' ws: wss:; img-src 'self' data: blob:; "
                  "frame-ancestors 'none'");
    response_.keep_alive(request.keep_alive() && answer.status == 200);
    response_.body() = {answer.body.data(), answer.body.size()};
    response_.prepare_payload();
    stream_.expires_after(kTimeToTake);
    http::async_write(
        stream_, response_, [self = shared_from_this()](error_code error, std::size_t) {
          if (!error && self->response_.keep_alive()) return self->Receive();
          self->stream_.socket().shutdown(tcp::socket::shutdown_send, error);
        });
  }

  Server& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{kLongestHeader};
  std::optional<http::request_parser<http::empty_body>> parser_;
  Response response_;
  bool is_upgraded_ = false;
};

}  // namespace

class WebServer::Listener {
 public:
  Listener(const WebServerOptions& options, WebHandler& handler)
      : server_{.handler = handler, .max_sockets = options.max_sockets} {
    try {
      const tcp::endpoint endpoint(asio::ip::make_address(options.address),
                                   static_cast<std::uint16_t>(options.port));
      acceptor_.open(endpoint.protocol());
      acceptor_.set_option(tcp::acceptor::reuse_address(true));
      acceptor_.bind(endpoint);
      acceptor_.listen();
    } catch (const boost::system::system_error& error) {
      throw WebError(
          fmt::format("view: cannot listen on {} port {}: {}; set view.address, view.port",
                      options.address,
                      options.port,
                      error.code().message()));
    }
    Accept();
    Tick();
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() { Stop(); }

  void Start() {
    thread_ = std::thread([this] {
      setpriority(PRIO_PROCESS, 0, kNicenessOfServer);
      context_.run();
    });
  }
  void Stop() {
    context_.stop();
    if (thread_.joinable()) thread_.join();
  }

  int port() const { return acceptor_.local_endpoint().port(); }

  void Post(std::function<void()> task) {
    asio::post(context_, [this, task = std::move(task)] {
      task();
      Kick();
    });
  }

  WebCounts counts() const {
    return {
        .sockets = server_.sockets, .connections = server_.connections, .refused = server_.refused};
  }

 private:
  void Accept() {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      if (!error) {
        Take(std::move(socket));
        return Accept();
      }
      // Out of descriptors: later there may be some again.
      pause_.expires_after(kTick);
      pause_.async_wait([this](error_code) { Accept(); });
    });
  }

  void Take(tcp::socket socket) {
    if (server_.connections >= server_.sockets + kMostPlainConnections) {
      ++server_.refused;  // Its end closes it.
      return;
    }
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    using UnsentLimit = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_NOTSENT_LOWAT>;
    socket.set_option(UnsentLimit(kUnsentBytes), ignored);
    std::make_shared<Connection>(std::move(socket), server_)->Receive();
  }

  /// What depends on time only is sent, too.
  void Tick() {
    tick_.expires_after(kTick);
    tick_.async_wait([this](error_code) {
      Kick();
      Tick();
    });
  }

  void Kick() const {
    for (const auto& kick : server_.kicks) kick();
  }

  Server server_;  // Outlives the connections, which the context holds.
  asio::io_context context_{1};
  tcp::acceptor acceptor_{context_};
  asio::steady_timer tick_{context_};
  asio::steady_timer pause_{context_};
  std::thread thread_;
};

WebServer::WebServer(const WebServerOptions& options, WebHandler& handler)
    : listener_(std::make_unique<Listener>(options, handler)) {}

WebServer::~WebServer() = default;

void WebServer::Start() { listener_->Start(); }

void WebServer::Stop() { listener_->Stop(); }

int WebServer::port() const { return listener_->port(); }

void WebServer::Post(std::function<void()> task) { listener_->Post(std::move(task)); }

WebCounts WebServer::counts() const { return listener_->counts(); }

}  // namespace qwsm::view
