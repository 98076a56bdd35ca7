// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/mark_conversion.hpp"

#include "service/dds/wire/planar.hpp"

namespace qwsm::dds {
namespace {

std::string TextOf(const char* text) { return text == nullptr ? std::string() : text; }

const std::string kNobody;

}  // namespace

wire::Mark ToWire(const team::Mark& mark, const std::string& map_frame) {
  wire::Mark sample{};
  sample.header = HeaderOf(mark.stamp, map_frame);
  sample.id = Borrow(mark.id);
  sample.kind = Borrow(mark.kind);
  sample.text = Borrow(mark.text);
  sample.author = Borrow(mark.author);
  sample.x = mark.p_map_m.x();
  sample.y = mark.p_map_m.y();
  sample.removed = mark.is_removed;
  sample.number = mark.number;
  sample.revision = mark.revision;
  sample.anchored = mark.anchor.has_value();
  sample.anchor_robot = Borrow(mark.anchor ? mark.anchor->robot : kNobody);
  if (!mark.anchor) return sample;
  sample.anchor_stamp = ToWire(mark.anchor->stamp);
  sample.anchor_x = mark.anchor->p_robot_m.x();
  sample.anchor_y = mark.anchor->p_robot_m.y();
  return sample;
}

std::string_view ObjectionTo(const wire::Mark& sample) {
  if (const auto objection = ObjectionTo(sample.header); !objection.empty()) return objection;
  if (!FromWire(sample.anchor_stamp)) return "a stamp in it is no time";
  return team::ObjectionTo(FromWire(sample));
}

team::Mark FromWire(const wire::Mark& sample) {
  team::Mark mark{.stamp = *FromWire(sample.header.stamp),
                  .revision = sample.revision,
                  .id = TextOf(sample.id),
                  .number = sample.number,
                  .kind = TextOf(sample.kind),
                  .text = TextOf(sample.text),
                  .author = TextOf(sample.author),
                  .p_map_m = {sample.x, sample.y},
                  .is_removed = sample.removed};
  if (sample.anchored) {
    mark.anchor = {.robot = TextOf(sample.anchor_robot),
                   .stamp = *FromWire(sample.anchor_stamp),
                   .p_robot_m = {sample.anchor_x, sample.anchor_y}};
  }
  return mark;
}

}  // namespace qwsm::dds
