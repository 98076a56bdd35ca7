// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/gateway/mark.hpp"

#include "service/dds/wire/planar.hpp"

namespace qwsm::dds {

wire::Mark ToWire(const Mark& mark) {
  wire::Mark sample{};
  sample.header = HeaderOf(mark.stamp, mark.frame);
  sample.id = Borrow(mark.id);
  sample.kind = Borrow(mark.kind);
  sample.text = Borrow(mark.text);
  sample.author = Borrow(mark.author);
  sample.x = mark.x_m;
  sample.y = mark.y_m;
  sample.removed = mark.is_removed;
  return sample;
}

}  // namespace qwsm::dds
