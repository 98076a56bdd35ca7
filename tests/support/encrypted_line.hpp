// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <openssl/ssl.h>

#include <cerrno>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/support/certificates.hpp"
#include "tests/support/web_line.hpp"

namespace qwsm::test {

/// A line as OpenSSL encrypts it, to a server that shows a certificate that is believed.
class EncryptedLine : public WebLine {
 public:
  /// @param believed of the server, which has to be called `localhost`.
  /// @param own who the client is; nobody where there is none.
  EncryptedLine(int port, const Certificate& believed, const Certificate* own = nullptr)
      : line_(port),
        context_(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free),
        ssl_(nullptr, &SSL_free) {
    X509_STORE_add_cert(SSL_CTX_get_cert_store(context_.get()), believed.certificate());
    SSL_CTX_set_verify(context_.get(), SSL_VERIFY_PEER, nullptr);
    if (own != nullptr) {
      SSL_CTX_use_certificate(context_.get(), own->certificate());
      SSL_CTX_use_PrivateKey(context_.get(), own->key());
    }
    ssl_.reset(SSL_new(context_.get()));
    SSL_set1_host(ssl_.get(), "localhost");
    SSL_set_fd(ssl_.get(), line_.socket());
    if (SSL_connect(ssl_.get()) != 1) {
      throw std::runtime_error(std::string("no encryption is agreed on: ") +
                               X509_verify_cert_error_string(SSL_get_verify_result(ssl_.get())));
    }
  }

  bool Write(std::string_view bytes) override {
    return SSL_write(ssl_.get(), bytes.data(), static_cast<int>(bytes.size())) > 0;
  }
  ssize_t ReadNow(char* bytes, std::size_t most) override {
    if (!WaitFor(std::chrono::milliseconds(0))) {
      errno = EAGAIN;
      return -1;
    }
    return std::max(SSL_read(ssl_.get(), bytes, static_cast<int>(most)), 0);
  }
  bool WaitFor(std::chrono::milliseconds period) override {
    return SSL_pending(ssl_.get()) > 0 || line_.WaitFor(period);
  }

 private:
  PlainLine line_;
  std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context_;
  std::unique_ptr<SSL, decltype(&SSL_free)> ssl_;
};

}  // namespace qwsm::test
