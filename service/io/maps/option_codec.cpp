// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/maps/option_codec.hpp"

#include <cstdint>

namespace qwsm::io {
namespace {

constexpr std::uint32_t kNumber = 0;
constexpr std::uint32_t kWord = 1;

}  // namespace

void AddOptions(BinaryWriter& writer, const OptionValues& values) {
  writer.Add(static_cast<std::uint64_t>(values.size()));
  for (const auto& [name, value] : values) {
    writer.Add(std::string_view(name));
    if (const auto* number = std::get_if<double>(&value)) {
      writer.Add(kNumber);
      writer.Add(*number);
    } else {
      writer.Add(kWord);
      writer.Add(std::string_view(std::get<std::string>(value)));
    }
  }
}

OptionValues ReadOptions(BinaryReader& reader) {
  OptionValues values;
  const std::size_t count = reader.Count(3 * sizeof(std::uint32_t));
  for (std::size_t i = 0; i < count; ++i) {
    std::string name(reader.Text());
    switch (reader.Unsigned32()) {
      case kNumber:
        values[name] = reader.Double();
        break;
      case kWord:
        values[name] = std::string(reader.Text());
        break;
      default:
        throw BinaryError("the option " + name + " is of an unknown kind");
    }
  }
  return values;
}

}  // namespace qwsm::io
