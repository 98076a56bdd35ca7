// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/bag_drive.hpp"

namespace qwsm::io {

std::vector<MadeMessage> Drive(Ros ros) {
  std::vector<MadeMessage> drive;
  for (int i = 0; i < 4; ++i) {
    drive.push_back(test::OdometryMessageOf(ros, "/odom", At(i), "base_link", OdometryAt(i)));
    drive.push_back(test::ScanMessage(ros, "/scan", At(i), "laser", RangesAt(i)));
  }
  drive.push_back(test::TransformMessageOf(
      ros, "/tf_static", Timestamp(0), "base_link", "laser", Spatial(kMounting)));
  return drive;
}

}  // namespace qwsm::io
