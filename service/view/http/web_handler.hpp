// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "service/view/live/client.hpp"

namespace qwsm::view {

/// What a browser asks for.
struct WebRequest {
  bool is_get = false;           ///< Or what comes before it only, HEAD.
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

}  // namespace qwsm::view
