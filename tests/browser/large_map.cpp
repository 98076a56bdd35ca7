// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// large_map TAG [TOPIC]: publishes a map of 100 x 100 m at 5 cm on /large/map, or another topic, on
// loopback, until it is killed.
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "service/dds/entities/writer.hpp"
#include "tests/support/drawn_map.hpp"

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::fputs("usage: large_map TAG [TOPIC]\n", stderr);
    return 2;
  }
  try {
    using namespace qwsm;
    const dds::Participant participant({.interface = "lo", .tag = argv[1]});
    const dds::Writer<dds::wire::OccupancyGrid> maps(
        participant, argc == 3 ? argv[2] : "/large/map", dds::Profile::kLatched);
    const test::DrawnMap map(2000, 40);
    maps.Write(map.sample());
    pause();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "large_map: %s\n", error.what());
  }
  return 1;
}
