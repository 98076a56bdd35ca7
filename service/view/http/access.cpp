// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/http/access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "service/view/http/web_error.hpp"

namespace qwsm::view {
namespace {

bool IsLoopback(std::string_view host) {
  constexpr std::array<std::string_view, 4> kNames{"localhost", "127.0.0.1", "::1", "[::1]"};
  return std::ranges::find(kNames, host) != kNames.end();
}

/// `localhost:8765` without its port.
std::string_view NameOf(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const bool is_port = colon != host.npos && host.find(']', colon) == host.npos;
  return is_port ? host.substr(0, colon) : host;
}

/// What stands behind `key=` in the query of a target.
std::string_view QueryValue(std::string_view target, std::string_view key) {
  std::size_t begin = target.find('?');
  while (begin != target.npos) {
    const std::size_t end = target.find('&', begin + 1);
    const std::string_view pair = target.substr(begin + 1, end - begin - 1);
    if (pair.starts_with(key) && pair.substr(key.size()).starts_with('=')) {
      return pair.substr(key.size() + 1);
    }
    begin = end;
  }
  return {};
}

/// Whether two texts are the same, in a time that does not tell where they differ.
bool IsSameSecret(std::string_view known, std::string_view told) {
  unsigned difference = known.size() == told.size() ? 0U : 1U;
  for (std::size_t i = 0; i < told.size(); ++i) {
    difference |= static_cast<unsigned char>(told[i]) ^
                  static_cast<unsigned char>(known[i % std::max<std::size_t>(known.size(), 1)]);
  }
  return difference == 0;
}

/// Whether an origin is one of a list with commas; browsers tell theirs without the slash at its end
/// that addresses have.
bool IsListed(std::string_view list, std::string_view item) {
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    std::string_view one = list.substr(0, comma);
    while (one.starts_with(' ')) one.remove_prefix(1);
    while (one.ends_with(' ') || one.ends_with('/')) one.remove_suffix(1);
    if (one == item) return true;
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return false;
}

WebAnswer Refusal(int status, std::string_view why) {
  return {.status = status, .type = "text/plain", .body = why};
}

}  // namespace

std::optional<TlsFiles> EncryptionOf(const ViewOptions& options) {
  if (options.certificate.empty() != options.key.empty()) {
    const bool has_key = options.certificate.empty();
    throw WebError(fmt::format("view.{}: is set, but view.{} is not: encryption needs both files",
                               has_key ? "key" : "certificate",
                               has_key ? "certificate" : "key"));
  }
  if (!options.certificate.empty()) {
    return TlsFiles{
        .certificate = options.certificate, .key = options.key, .client_ca = options.client_ca};
  }
  if (!options.client_ca.empty()) {
    throw WebError("view.client_ca: is of use with view.certificate and view.key only");
  }
  return std::nullopt;
}

Access::Access(const ViewOptions& options)
    : options_(options), is_loopback_(IsLoopback(options.address)) {
  if (!is_loopback_ && options_.token.empty() && options_.client_ca.empty()) {
    throw WebError(fmt::format(
        "view.address: others can reach {}; set view.token to a secret that whoever may "
        "look knows, or view.client_ca to who vouches for them, or leave the address at 127.0.0.1",
        options_.address));
  }
  const bool is_plain = std::ranges::all_of(options_.token, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
  if (!is_plain) {
    throw WebError(
        "view.token: must have letters, digits, '-', '_' and '.' only: it is a part of an "
        "address");
  }
}

std::optional<WebAnswer> Access::Objection(const WebRequest& request) const {
  if (is_loopback_ && !IsLoopback(NameOf(request.host))) {
    return Refusal(403, "on this computer only; ask for localhost\n");
  }
  if (!request.origin.empty() && !IsOwnOrigin(request)) {
    return Refusal(403, "this page may not connect; view.origins names those that may\n");
  }
  if (!options_.token.empty() && !IsTokenRight(request.target)) {
    return Refusal(401, "the token is missing or wrong: add ?token=... (view.token)\n");
  }
  return std::nullopt;
}

bool Access::IsOwnOrigin(const WebRequest& request) const {
  const std::string_view scheme = options_.certificate.empty() ? "http" : "https";
  return request.origin == fmt::format("{}://{}", scheme, request.host) ||
         IsListed(options_.origins, request.origin);
}

bool Access::IsTokenRight(std::string_view target) const {
  return IsSameSecret(options_.token, QueryValue(target, "token"));
}

}  // namespace qwsm::view
