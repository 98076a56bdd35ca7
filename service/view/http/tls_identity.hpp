// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace boost::asio::ssl {
class context;
}

namespace qwsm::view {

/// Files by which a server shows who it is, each with text in PEM form.
struct TlsFiles {
  std::filesystem::path certificate{};  ///< Its own, then those that vouch for it.
  std::filesystem::path key{};          ///< Of its own certificate, without a password.
  std::filesystem::path client_ca{};    ///< Who vouches for those let in; empty: all are.
};

/// Who a server is to those who encrypt what they say to it, and whom it believes in turn.
class TlsIdentity {
 public:
  /// Reads the files. @throws WebError that names setting and file, and says how to mend it.
  explicit TlsIdentity(const TlsFiles& files);

  /// For streams that it outlives.
  boost::asio::ssl::context& context() const { return *context_; }
  /// A name by which browsers reach the server and believe it: `localhost` where they do that.
  const std::string& host() const { return host_; }
  /// What else is to be told; empty where all is well.
  const std::string& warning() const { return warning_; }

 private:
  std::shared_ptr<boost::asio::ssl::context> context_;
  std::string host_ = "localhost";
  std::string warning_{};
};

}  // namespace qwsm::view
