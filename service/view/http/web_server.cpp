// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/http/web_server.hpp"

#include <fmt/format.h>
#include <netinet/tcp.h>
#include <sys/resource.h>

#include <boost/asio.hpp>
#include <chrono>
#include <thread>
#include <utility>

#include "service/view/http/beast/server.hpp"
#include "service/view/http/beast/welcome.hpp"
#include "service/view/http/tls_identity.hpp"

namespace qwsm::view {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr int kNicenessOfServer = 5;
constexpr std::chrono::milliseconds kTick{100};
// Connections that have not become sockets: of one browser, six.
constexpr std::size_t kMostPlainConnections = 64;
// What waits in the kernel cannot be overtaken by what is newer.
constexpr int kUnsentBytes = 4 * 1024;

asio::ip::address AddressOf(const std::string& text) {
  error_code error;
  const asio::ip::address address =
      asio::ip::make_address(text == "localhost" ? "127.0.0.1" : text, error);
  if (!error) return address;
  throw WebError(fmt::format(
      "view.address: must be an address in numbers, such as 127.0.0.1, or localhost, got '{}'",
      text));
}

}  // namespace

class WebServer::Listener {
 public:
  Listener(const WebServerOptions& options, WebHandler& handler)
      : server_{.handler = handler, .max_sockets = options.max_sockets},
        identity_(options.identity) {
    try {
      const tcp::endpoint endpoint(AddressOf(options.address),
                                   static_cast<std::uint16_t>(options.port));
      acceptor_.open(endpoint.protocol());
      acceptor_.set_option(tcp::acceptor::reuse_address(true));
      acceptor_.bind(endpoint);
      acceptor_.listen();
    } catch (const boost::system::system_error& error) {
      throw WebError(fmt::format(
          "view: cannot listen on {} port {}: {}; set view.address, view.port, or 0 for any "
          "port that is free (qwsm sim: --page port=0)",
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
    if (!identity_) return WelcomePlain(std::move(socket), server_);
    WelcomeEncrypted(std::move(socket), identity_->context(), server_);
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

  // Both outlive the connections, which the context holds.
  Server server_;
  std::optional<TlsIdentity> identity_;
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
