// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "service/view/http/tls_identity.hpp"
#include "service/view/http/web_handler.hpp"
#include "service/view/view_options.hpp"

namespace qwsm::view {

/// The files for encryption that the options name; nothing where they want none.
/// @throws WebError where one is named without another that it needs.
std::optional<TlsFiles> EncryptionOf(const ViewOptions& options);

/// Decides who may connect.
///
/// A page of somebody else, open in the operator's browser, can reach this computer's ports, too: a
/// browser is let in only from our own page, or those named. On the loopback it must call us by a
/// name of the loopback, for any other name may have been pointed here to make its page ours.
class Access {
 public:
  /// @throws WebError where others could reach the port, and need neither token nor certificate.
  explicit Access(const ViewOptions& options);

  /// Why a socket is refused; nothing where it is let in.
  std::optional<WebAnswer> Objection(const WebRequest& request) const;

 private:
  bool IsOwnOrigin(const WebRequest& request) const;
  bool IsTokenRight(std::string_view target) const;

  ViewOptions options_;
  bool is_loopback_;
};

}  // namespace qwsm::view
