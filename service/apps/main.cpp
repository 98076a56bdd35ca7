// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/qwsm.hpp"

int main(int argc, char** argv) { return qwsm::apps::RunQwsm(argc, argv); }
