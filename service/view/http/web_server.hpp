// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "service/view/http/tls_identity.hpp"
#include "service/view/http/web_error.hpp"
#include "service/view/http/web_handler.hpp"

namespace qwsm::view {

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
