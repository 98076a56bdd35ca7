// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "service/view/http/tls_identity.hpp"
#include "service/view/http/web_error.hpp"
#include "service/view/live/client.hpp"

namespace qwsm::view {

/// What a browser asks for.
struct WebRequest {
  bool is_get = false;
  std::string_view target{};     ///< Path and query.
  std::string_view host{};       ///< What the client calls us.
  std::string_view origin{};     ///< The page that asks; empty where no browser does.
  std::string_view protocols{};  ///< What a socket may speak, in order of preference.
};

struct WebAnswer {
  int status = 200;
  std::string_view type{};
  std::string_view body{};  ///< Lives as long as the program.
};

/// What is behind the port. Called in the server's thread.
class WebHandler {
 public:
  WebHandler() = default;
  WebHandler(const WebHandler&) = delete;
  WebHandler& operator=(const WebHandler&) = delete;
  virtual ~WebHandler() = default;

  virtual WebAnswer Answer(const WebRequest& request) = 0;
  /// Why a socket is refused; nothing where it is let in.
  virtual std::optional<WebAnswer> Objection(const WebRequest& request) = 0;
  virtual std::unique_ptr<Client> Open() = 0;
};

struct WebServerOptions {
  std::string address;
  int port = 0;
  std::size_t max_sockets = 32;
  std::optional<TlsIdentity> identity{};  ///< Without one, nothing is encrypted.
};

/// How much there was to do, and to refuse.
struct WebCounts {
  std::size_t sockets = 0;      ///< Open now.
  std::size_t connections = 0;  ///< Open now, sockets included.
  std::size_t refused = 0;      ///< Turned away so far: too many, or not allowed.
};

/// An HTTP server with WebSockets, in a thread of its own that gives way to all others.
///
/// Each connection has bounded memory, and time: who is slow to ask is cut off, who reads slowly
/// misses what is outdated (see Client), who says too much is heard more slowly.
class WebServer {
 public:
  /// Takes the port; whoever connects waits until Start(). @param handler outlives this.
  /// @throws WebError.
  WebServer(const WebServerOptions& options, WebHandler& handler);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  ~WebServer();

  void Start();
  /// Answers nobody any more: the handler is not called again.
  void Stop();

  int port() const;
  /// Does something in the server's thread, then sends what there is to send. Any thread may call.
  void Post(std::function<void()> task);
  WebCounts counts() const;

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
};

}  // namespace qwsm::view
