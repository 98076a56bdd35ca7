// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/containers/ros1_bag.hpp"

#include <algorithm>

#include "service/io/bags/containers/chunk_codec.hpp"
#include "service/io/files/binary.hpp"

namespace qwsm::io {
namespace {

using std::literals::operator""sv;

constexpr std::string_view kBagMagic = "#ROSBAG V"sv;
constexpr std::string_view kBagVersion = "#ROSBAG V2.0\n"sv;
constexpr std::size_t kMostHeaderBytes = 1 << 16;
constexpr std::size_t kMostBodyBytes = std::size_t{256} << 20;
constexpr std::uint64_t kOutside = ~std::uint64_t{0};  // An address outside of all chunks.

constexpr std::string_view kMessageOp = "\x02"sv;
constexpr std::string_view kBagHeaderOp = "\x03"sv;
constexpr std::string_view kChunkOp = "\x05"sv;
constexpr std::string_view kConnectionOp = "\x07"sv;

/// The value of a field of a header; nothing where it has none of that name.
/// @throws BinaryError where the header is none.
std::optional<std::string_view> FieldOf(std::string_view header, std::string_view name) {
  BinaryReader fields(header);
  std::optional<std::string_view> value;
  while (fields.remaining() > 0) {
    const std::string_view field = fields.Text();
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) throw BinaryError("a field has no name");
    if (field.substr(0, equals) == name && !value) value = field.substr(equals + 1);
  }
  return value;
}

std::uint32_t NumberOf(std::string_view header, std::string_view name) {
  return BinaryReader(FieldOf(header, name).value_or(""sv)).Unsigned32();
}

bool IsHeader(std::string_view header) {
  try {
    return FieldOf(header, "op").has_value();
  } catch (const BinaryError&) {
    return false;
  }
}

}  // namespace

bool Ros1Bag::Recognizes(std::string_view first_bytes) {
  return first_bytes.starts_with(kBagMagic);
}

Ros1Bag::Ros1Bag(const std::filesystem::path& path, TellDamage tell)
    : ChunkedBag(path, std::move(tell), kBagVersion.size()) {
  if (file_.At(0, kBagVersion.size()) != kBagVersion) {
    throw BagError("is a bag of another format than 2.0; 'rosbag fix' makes a new one of it");
  }
  ReadIndex();
}

/// Takes the connections at the end of the bag: they are known even where their chunk is damaged.
void Ros1Bag::ReadIndex() {
  try {
    const std::optional<Record> head = RecordAt(next_);
    if (!head || FieldOf(head->header, "op") != kBagHeaderOp) return;
    std::uint64_t offset =
        BinaryReader(FieldOf(head->header, "index_pos").value_or(""sv)).Unsigned64();
    if (offset < next_) return;  // The bag was never closed.
    for (std::optional<Record> record = RecordAt(offset);
         record && FieldOf(record->header, "op") == kConnectionOp;
         record = RecordAt(offset)) {
      TakeConnection(*record);
      offset += record->size;
    }
  } catch (const BinaryError&) {
    // Whatever is damaged is met, and told, again.
  }
}

std::optional<BagMessage> Ros1Bag::NextInChunk() {
  const std::uint64_t offset = chunk_->offset;
  BinaryReader rest(std::string_view(chunks_.At(offset)).substr(chunk_->next));
  while (rest.remaining() > 0) {
    try {
      const std::size_t before = rest.remaining();
      const std::size_t at = chunk_->next;
      const std::string_view header = rest.Text();
      const Record record{.header = header, .body = rest.Text(), .size = 0};
      chunk_->next += before - rest.remaining();
      if (std::optional<BagMessage> message = Take(record, {offset, at})) return message;
    } catch (const BinaryError&) {
      tell_(offset, "a record of a chunk is longer than what is left of the chunk");
      break;
    }
  }
  chunk_.reset();
  return std::nullopt;
}

/// The record at an offset, with what is there of its contents; nothing where none begins there.
std::optional<Ros1Bag::Record> Ros1Bag::RecordAt(std::uint64_t offset) {
  const std::string_view start = file_.At(offset, sizeof(std::uint32_t));
  if (start.size() < sizeof(std::uint32_t)) return std::nullopt;
  const std::size_t header_size = BinaryReader(start).Unsigned32();
  if (header_size > kMostHeaderBytes) return std::nullopt;
  const std::size_t head_size = header_size + 2 * sizeof(std::uint32_t);
  const std::string_view head = file_.At(offset, head_size);
  if (head.size() < head_size) return std::nullopt;
  if (!IsHeader(head.substr(sizeof(std::uint32_t), header_size))) return std::nullopt;
  const std::size_t body_size = BinaryReader(head.substr(head_size - 4)).Unsigned32();
  const std::string_view whole = file_.At(offset, head_size + std::min(body_size, kMostBodyBytes));
  return Record{.header = whole.substr(sizeof(std::uint32_t), header_size),
                .body = whole.substr(std::min(head_size, whole.size())),
                .size = head_size + body_size};
}

std::optional<BagMessage> Ros1Bag::NextInFile() {
  const std::uint64_t offset = next_;
  if (offset == file_.size()) {
    ended_ = true;
    return std::nullopt;
  }
  const std::optional<Record> record = RecordAt(offset);
  if (!record) {
    GoAround(offset, "the file is cut off here, or damaged");
    return std::nullopt;
  }
  const bool fits = record->size <= file_.size() - offset;
  if (FieldOf(record->header, "op") == kChunkOp) {
    chunk_ = Chunk{.offset = offset};
    if (!fits) {
      GoAround(offset, "the file is cut off within this chunk, or the chunk is damaged");
      return std::nullopt;
    }
  } else if (!fits) {
    GoAround(offset, "the file is cut off here, or damaged");
    return std::nullopt;
  }
  next_ = offset + record->size;
  return chunk_ ? std::nullopt : Take(*record, {offset, kOutside});
}

std::optional<BagMessage> Ros1Bag::Take(const Record& record, const MessageAddress& address) {
  try {
    const std::string_view op = FieldOf(record.header, "op").value_or(""sv);
    if (op == kConnectionOp) TakeConnection(record);
    if (op != kMessageOp) return std::nullopt;
    const auto connection = connections_.find(NumberOf(record.header, "conn"));
    if (connection != connections_.end()) {
      return BagMessage{.topic = connection->second, .address = address, .bytes = record.body};
    }
    tell_(address.container, "a message belongs to a connection that was not declared");
  } catch (const BinaryError&) {
    tell_(address.container, "the header of a record is damaged");
  }
  return std::nullopt;
}

/// A connection: its topic is in the header, its type among fields of the same kind in the body.
void Ros1Bag::TakeConnection(const Record& record) {
  const std::uint32_t id = NumberOf(record.header, "conn");
  if (connections_.contains(id)) return;  // Chunks and the index repeat it.
  const std::string_view topic = FieldOf(record.header, "topic").value_or(""sv);
  const std::string_view type = FieldOf(record.body, "type").value_or(""sv);
  connections_.emplace(id, topics_.size());
  topics_.push_back(
      {.name = std::string(topic), .type = PlainTypeName(type), .encoding = Encoding::kRos1});
}

std::string_view Ros1Bag::Read(const MessageAddress& address) {
  if (address.at == kOutside) return RecordAt(address.container).value_or(Record{}).body;
  BinaryReader rest(std::string_view(chunks_.At(address.container)).substr(address.at));
  rest.Text();  // The header.
  return rest.Text();
}

/// The plain bytes of a chunk, or as many as are good. What is wrong is told each time it is read.
std::string Ros1Bag::LoadChunk(std::uint64_t offset) {
  const Record record = RecordAt(offset).value_or(Record{});
  const std::string_view compression = FieldOf(record.header, "compression").value_or("none"sv);
  PlainChunk plain = Decompress(compression, record.body);
  if (!plain.problem.empty()) tell_(offset, "a chunk is damaged: " + plain.problem);
  return std::move(plain.bytes);
}

/// The first chunk that begins at `from` or behind: one of its fields says what it is, and no field
/// before that is longer than the name of a compression.
std::optional<std::uint64_t> Ros1Bag::FindChunk(std::uint64_t from) {
  constexpr std::string_view kMark = "\x04\0\0\0op=\x05"sv;
  constexpr std::size_t kFarthest = 64;
  constexpr std::size_t kPiece = std::size_t{1} << 17;
  std::string piece;
  for (std::uint64_t begin = from; begin < file_.size(); begin += kPiece) {
    piece = file_.At(begin, kPiece + kMark.size());
    for (std::size_t mark = piece.find(kMark); mark != std::string::npos;
         mark = piece.find(kMark, mark + 1)) {
      const std::uint64_t at = begin + mark;
      const std::uint64_t first = std::max(from, at - std::min<std::uint64_t>(at, kFarthest));
      for (std::uint64_t offset = first; offset + sizeof(std::uint32_t) <= at; ++offset) {
        const std::optional<Record> record = RecordAt(offset);
        if (record && FieldOf(record->header, "op") == kChunkOp) return offset;
      }
    }
  }
  return std::nullopt;
}

}  // namespace qwsm::io
