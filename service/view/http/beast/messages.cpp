// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/http/beast/messages.hpp"

#include <algorithm>
#include <iterator>
#include <string>

namespace qwsm::view {
namespace {

std::string_view ToView(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

WebRequest ToWebRequest(const HttpRequest& request) {
  const http::verb method = request.method();
  return {.is_get = method == http::verb::get || method == http::verb::head,
          .target = ToView(request.target()),
          .host = ToView(request[http::field::host]),
          .origin = ToView(request[http::field::origin]),
          .protocols = ToView(request[http::field::sec_websocket_protocol])};
}

HttpResponse ToHttpResponse(const WebAnswer& answer, const HttpRequest& request) {
  HttpResponse response;
  response.version(request.version());
  response.result(static_cast<unsigned>(answer.status));
  response.set(http::field::content_type, std::string(answer.type));
  response.set(http::field::cache_control, "no-cache");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Content-Security-Policy",
               "default-src 'self'; connect-src 'self' ws: wss:; img-src 'self' data: blob:; "
               "frame-ancestors 'none'");
  response.keep_alive(request.keep_alive() && answer.status == 200);
  response.body() = {answer.body.data(), answer.body.size()};
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body() = {};  // All but that is told.
  return response;
}

std::string_view ChooseProtocol(std::string_view offered) {
  for (const auto& name : http::token_list({offered.data(), offered.size()})) {
    const auto* const ours = std::ranges::find(kProtocolNames, ToView(name));
    if (ours != std::end(kProtocolNames)) return *ours;
  }
  return {};
}

}  // namespace qwsm::view
