// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace qwsm::view {

/// Says who may look at the service, and where.
struct ViewOptions {
  int port = 8765;
  std::string address = "127.0.0.1";
  std::string token{};
  std::string certificate{};
  std::string key{};
  std::string client_ca{};
  std::string origins{};
  int max_clients = 32;
};

template <class Visitor>
void Describe(Visitor& visit, ViewOptions& o) {
  visit("port", o.port, {.help = "TCP port of the page; 0: any free one", .min = 0, .max = 65535});
  visit("address",
        o.address,
        {.help = "on which it listens; 0.0.0.0: all, which needs view.token or view.client_ca"});
  visit("token",
        o.token,
        {.help = "whoever connects must know it, as ?token=...; empty: for this computer alone"});
  visit("certificate",
        o.certificate,
        {.help = "PEM file with the server's certificate, and those that vouch for it: the page is "
                 "https then; empty: nothing is encrypted"});
  visit("key", o.key, {.help = "PEM file with the certificate's private key"});
  visit("client_ca",
        o.client_ca,
        {.help = "PEM file: let in only browsers with a certificate that one of these has signed"});
  visit(
      "origins",
      o.origins,
      {.help = "pages of others that may connect, such as https://app.foxglove.dev; with commas"});
  visit("max_clients", o.max_clients, {.help = "so many may look at once", .min = 1, .max = 1000});
}

}  // namespace qwsm::view
