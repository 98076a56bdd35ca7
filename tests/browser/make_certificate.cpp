// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// make_certificate NAME: writes NAME.pem and NAME.key, of `localhost` and for an hour.
#include <cstdio>
#include <exception>

#include "tests/support/certificates.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: make_certificate NAME\n", stderr);
    return 2;
  }
  try {
    qwsm::test::Certificate("localhost").Write(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_certificate: %s\n", error.what());
    return 1;
  }
}
