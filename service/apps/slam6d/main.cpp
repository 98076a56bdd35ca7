// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/slam6d/slam6d.hpp"

int main(int argc, char** argv) { return slam6d::apps::RunSlam6d(argc, argv); }
