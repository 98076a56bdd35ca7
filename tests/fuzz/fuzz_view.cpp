// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "service/io/bags/messages/message_reader.hpp"
#include "service/view/protocol/client_message.hpp"
#include "service/view/protocol/told_mark.hpp"
#include "service/view/protocol/told_pose.hpp"
#include "service/view/streams/map_tiles.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace qwsm::view;
using qwsm::test::Expect;

/// What it comes to; nothing where it is none. Any other exception ends the fuzzer.
template <class Error, class Parse>
auto Parsed(Parse parse) -> std::optional<decltype(parse())> {
  try {
    return parse();
  } catch (const Error& error) {
    Expect(error.what()[0] != '\0');
    return std::nullopt;
  }
}

void TakeMap(std::string_view bytes) {
  const auto grid = Parsed<qwsm::io::MessageError>([&] { return DecodeGrid(bytes); });
  if (!grid) return;
  MapTiles tiles;
  tiles.Take(*grid, 0, {});
  Cursor cursor = tiles.Begin();
  for (std::size_t i = 0; i < tiles.size(); ++i) Expect(tiles.Next(cursor, {}).has_value());
  Expect(!tiles.Next(cursor, {}));
}

}  // namespace

/// Any bytes as anything that comes from a client, or as a map: the first byte says what.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      Parsed<ProtocolError>([&] { return ParseClientText(bytes); });
      break;
    case 1: {
      const auto message = Parsed<ProtocolError>([&] { return ParseClientData(bytes); });
      if (message) Parsed<qwsm::io::MessageError>([&] { return DecodeToldPose(message->cdr); });
      break;
    }
    case 2: {
      const auto mark = Parsed<qwsm::io::MessageError>([&] { return DecodeToldMark(bytes); });
      Expect(!mark || ObjectionTo(*mark).empty());
      break;
    }
    default:
      TakeMap(bytes);
  }
  return 0;
}
