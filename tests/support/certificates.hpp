// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace qwsm::test {

/// A certificate with its key, made for a test: of its own, or signed by another one.
class Certificate {
 public:
  struct Validity {
    std::chrono::seconds from = std::chrono::hours(-1);  ///< From now.
    std::chrono::seconds until = std::chrono::hours(1);
  };

  explicit Certificate(const std::string& name) : Certificate(name, nullptr, Validity{}) {}
  Certificate(const std::string& name, const Certificate* issuer, Validity validity)
      : key_(EVP_EC_gen("P-256"), &EVP_PKEY_free), certificate_(X509_new(), &X509_free) {
    X509* const x = certificate_.get();
    static long count = 0;
    X509_set_version(x, X509_VERSION_3);
    ASN1_INTEGER_set(X509_get_serialNumber(x), ++count);
    X509_gmtime_adj(X509_getm_notBefore(x), validity.from.count());
    X509_gmtime_adj(X509_getm_notAfter(x), validity.until.count());
    X509_set_pubkey(x, key_.get());
    X509_NAME_add_entry_by_txt(X509_get_subject_name(x),
                               "CN",
                               MBSTRING_ASC,
                               reinterpret_cast<const unsigned char*>(name.c_str()),
                               -1,
                               -1,
                               0);
    const Certificate& signer = issuer == nullptr ? *this : *issuer;
    X509_set_issuer_name(x, X509_get_subject_name(signer.certificate_.get()));
    Extend(NID_subject_alt_name, "DNS:" + name);
    if (issuer == nullptr) Extend(NID_basic_constraints, "critical,CA:TRUE");
    if (X509_sign(x, signer.key_.get(), EVP_sha256()) == 0) {
      throw std::runtime_error("cannot sign a certificate");
    }
  }

  /// Writes both as PEM files NAME.pem and NAME.key.
  void Write(const std::filesystem::path& name) const {
    WriteWith(name.string() + ".pem",
              [&](std::FILE* file) { return PEM_write_X509(file, certificate_.get()); });
    WriteWith(name.string() + ".key", [&](std::FILE* file) {
      return PEM_write_PrivateKey(file, key_.get(), nullptr, nullptr, 0, nullptr, nullptr);
    });
  }
  /// Writes the key so that it needs a password.
  void WriteProtectedKey(const std::filesystem::path& path) const {
    WriteWith(path, [&](std::FILE* file) {
      std::string password = "secret";
      return PEM_write_PrivateKey(file,
                                  key_.get(),
                                  EVP_aes_128_cbc(),
                                  reinterpret_cast<unsigned char*>(password.data()),
                                  static_cast<int>(password.size()),
                                  nullptr,
                                  nullptr);
    });
  }

  X509* certificate() const { return certificate_.get(); }
  EVP_PKEY* key() const { return key_.get(); }

 private:
  void Extend(int what, const std::string& value) {
    const std::unique_ptr<X509_EXTENSION, decltype(&X509_EXTENSION_free)> extension(
        X509V3_EXT_conf_nid(nullptr, nullptr, what, value.c_str()), &X509_EXTENSION_free);
    X509_add_ext(certificate_.get(), extension.get(), -1);
  }

  template <class Writer>
  static void WriteWith(const std::filesystem::path& path, const Writer& write) {
    const std::unique_ptr<std::FILE, decltype(&std::fclose)> file(std::fopen(path.c_str(), "w"),
                                                                  &std::fclose);
    if (!file || write(file.get()) != 1) throw std::runtime_error("cannot write " + path.string());
  }

  std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key_;
  std::unique_ptr<X509, decltype(&X509_free)> certificate_;
};

}  // namespace qwsm::test
