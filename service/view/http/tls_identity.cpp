// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/http/tls_identity.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <boost/asio/ssl/context.hpp>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "service/view/http/web_error.hpp"

namespace qwsm::view {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

/// A setting and the file that it names.
struct NamedFile {
  std::string_view setting;
  const std::filesystem::path& path;

  [[noreturn]] void Complain(std::string_view what) const {
    throw WebError(fmt::format("{}: {}: {}", setting, path.string(), what));
  }
};

std::string TextOf(const NamedFile& file) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(file.path, error);
  if (error) file.Complain(fmt::format("cannot be read: {}", error.message()));
  if (!is_file) file.Complain("is no file");
  errno = 0;
  std::ifstream stream(file.path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream) {
    file.Complain(fmt::format("cannot be read: {}",
                              std::generic_category().message(errno != 0 ? errno : EIO)));
  }
  return text;
}

std::string DayOf(const ASN1_TIME* time) {
  std::tm parts{};
  return ASN1_TIME_to_tm(time, &parts) == 1 ? fmt::format("{:%F}", parts) : "an unknown day";
}

void UseCertificate(asio::ssl::context& context, const NamedFile& file) {
  error_code error;
  context.use_certificate_chain(asio::buffer(TextOf(file)), error);
  if (error) {
    file.Complain(fmt::format(
        "holds no certificate that can be used: it must begin with BEGIN CERTIFICATE (PEM): {}",
        error.message()));
  }
  const X509* const certificate = SSL_CTX_get0_certificate(context.native_handle());
  const ASN1_TIME* const end = X509_get0_notAfter(certificate);
  if (X509_cmp_current_time(end) < 0) {
    file.Complain(fmt::format(
        "has expired on {}: no browser believes it; make a new one (docs/view.md)", DayOf(end)));
  }
}

void UseKey(asio::ssl::context& context, const NamedFile& file, const NamedFile& certificate) {
  error_code error;
  bool is_protected = false;
  context.set_password_callback(
      [&](std::size_t, asio::ssl::context::password_purpose) {
        is_protected = true;
        return std::string();
      },
      error);
  context.use_private_key(asio::buffer(TextOf(file)), asio::ssl::context::pem, error);
  if (is_protected) {
    file.Complain("needs a password, which nobody can type: write one without, with openssl pkey");
  }
  const bool is_key = !error || ERR_GET_REASON(static_cast<unsigned long>(error.value())) ==
                                    X509_R_KEY_VALUES_MISMATCH;
  if (!is_key) {
    file.Complain(
        fmt::format("holds no private key that can be used, in PEM form: {}", error.message()));
  }
  if (error || SSL_CTX_check_private_key(context.native_handle()) != 1) {
    file.Complain(fmt::format("is not the key of the certificate {} (view.certificate)",
                              certificate.path.string()));
  }
}

/// From now on only those are let in for whom one of the file's certificates vouches.
void BelieveOnly(asio::ssl::context& context, const NamedFile& file) {
  error_code error;
  context.add_certificate_authority(asio::buffer(TextOf(file)), error);
  STACK_OF(X509_NAME)* const names = error ? nullptr : SSL_load_client_CA_file(file.path.c_str());
  if (names == nullptr) {
    file.Complain(
        fmt::format("holds no certificates, in PEM form, of those who vouch: {}", error.message()));
  }
  SSL_CTX_set_client_CA_list(context.native_handle(), names);
  context.set_verify_mode(asio::ssl::verify_peer | asio::ssl::verify_fail_if_no_peer_cert);
}

asio::ssl::context ContextOfServer() {
  asio::ssl::context context(asio::ssl::context::tls_server);
  SSL_CTX* const handle = context.native_handle();
  SSL_CTX_set_min_proto_version(handle, TLS1_2_VERSION);
  // Nobody makes the server work without end, and nothing is kept of who has gone.
  SSL_CTX_set_options(handle, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_NO_TICKET);
  SSL_CTX_set_num_tickets(handle, 0);
  SSL_CTX_set_session_cache_mode(handle, SSL_SESS_CACHE_OFF);
  return context;
}

/// The first name of a certificate that is one host's.
std::string NameOfHost(X509* certificate) {
  constexpr std::string_view kLocal = "localhost";
  if (X509_check_host(certificate, kLocal.data(), kLocal.size(), 0, nullptr) == 1) {
    return std::string(kLocal);
  }
  const std::unique_ptr<GENERAL_NAMES, decltype(&GENERAL_NAMES_free)> names(
      static_cast<GENERAL_NAMES*>(
          X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr)),
      &GENERAL_NAMES_free);
  for (int i = 0; i < sk_GENERAL_NAME_num(names.get()); ++i) {
    const GENERAL_NAME* const name = sk_GENERAL_NAME_value(names.get(), i);
    if (name->type != GEN_DNS) continue;
    const auto* const text = ASN1_STRING_get0_data(name->d.dNSName);
    std::string host(text, text + ASN1_STRING_length(name->d.dNSName));
    if (host.find('*') == host.npos) return host;
  }
  return std::string(kLocal);
}

}  // namespace

TlsIdentity::TlsIdentity(const TlsFiles& files)
    : context_(std::make_shared<asio::ssl::context>(ContextOfServer())) {
  const NamedFile certificate{"view.certificate", files.certificate};
  UseCertificate(*context_, certificate);
  UseKey(*context_, {"view.key", files.key}, certificate);
  if (!files.client_ca.empty()) BelieveOnly(*context_, {"view.client_ca", files.client_ca});

  X509* const own = SSL_CTX_get0_certificate(context_->native_handle());
  host_ = NameOfHost(own);
  const ASN1_TIME* const begin = X509_get0_notBefore(own);
  if (X509_cmp_current_time(begin) > 0) {
    warning_ = fmt::format(
        "view.certificate: {}: is valid from {} on only; is this computer's clock right?",
        files.certificate.string(),
        DayOf(begin));
  }
}

}  // namespace qwsm::view
