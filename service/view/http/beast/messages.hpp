// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <string_view>

#include "service/view/http/web_handler.hpp"

namespace qwsm::view {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using beast::error_code;

using HttpRequest = http::request<http::empty_body>;
using HttpResponse = http::response<http::span_body<const char>>;

/// What is asked, as a view of the request.
WebRequest ToWebRequest(const HttpRequest& request);

/// An answer as it is sent, with what every browser has to heed.
HttpResponse ToHttpResponse(const WebAnswer& answer, const HttpRequest& request);

/// The first protocol of ours that a socket offers; nothing where there is none.
std::string_view ChooseProtocol(std::string_view offered);

}  // namespace qwsm::view
