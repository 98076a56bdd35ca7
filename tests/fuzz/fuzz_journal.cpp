// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/binary.hpp"
#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/room_drive.hpp"

namespace {

namespace fs = std::filesystem;
using qwsm::test::Expect;
using qwsm::test::InputFile;
using namespace qwsm::io;

constexpr std::uint64_t kScans = 60;
constexpr std::size_t kLeastBytesOfEntry = 16;

JournalEntry EntryOf(std::uint64_t sequence) {
  const qwsm::Observation observation = qwsm::test::ObservationInRoom(static_cast<int>(sequence));
  return {.service = "base",
          .robot = "robot1",
          .sequence = sequence,
          .stamp = observation.scan.stamp,
          .contents = EncodeScan({.relevant = {.scan = observation.scan, .map_robot = {}},
                                  .T_odom_robot = observation.T_odom_robot})};
}

/// The bytes of a journal that is sound.
const std::string& SoundJournal() {
  static const std::string kBytes = [] {
    const InputFile file("sound.db");
    std::vector<JournalEntry> entries;
    for (std::uint64_t sequence = 1; sequence <= kScans; ++sequence) {
      entries.push_back(EntryOf(sequence));
    }
    JournalFile::Continue(file.path(), kScanJournal, "base-1").Append(entries);
    return qwsm::test::ReadFile(file.path());
  }();
  return kBytes;
}

/// The sound journal with some of its bytes altered: where, in three bytes, and by what.
std::string Altered(std::string_view edits) {
  std::string bytes = SoundJournal();
  for (; edits.size() >= 4; edits.remove_prefix(4)) {
    std::size_t at = 0;
    for (int i = 0; i < 3; ++i) {
      at = at << 8U | static_cast<unsigned char>(edits[static_cast<std::size_t>(i)]);
    }
    bytes[at % bytes.size()] = static_cast<char>(bytes[at % bytes.size()] ^ edits[3]);
  }
  return bytes;
}

/// Reads all there is. @return how many entries.
std::size_t ReadOn(JournalFile& journal, std::size_t file_bytes) {
  std::size_t entries = 0;
  while (const std::optional<JournalEntry> entry = journal.Next()) {
    Expect(++entries <= file_bytes / kLeastBytesOfEntry);
    try {
      DecodeScan(entry->contents);
    } catch (const BinaryError&) {
    }
  }
  return entries;
}

void TryJournal(const InputFile& file, const std::string& bytes) {
  for (const fs::directory_entry& old : fs::directory_iterator(file.path().parent_path())) {
    fs::remove(old);
  }
  file.Write(bytes);
  try {
    JournalFile read = JournalFile::Read(file.path(), kScanJournal);
    const std::size_t kept = ReadOn(read, bytes.size());
    JournalFile continued = JournalFile::Continue(file.path(), kScanJournal, "base-1");
    // SQLite reads a cell that reaches beyond its page from what lies there in memory: two readings
    // may differ in which entries they find.
    Expect(ReadOn(continued, bytes.size()) + continued.damaged() >= kept);
    continued.Append(std::vector{EntryOf(kScans + 1)});
    Expect(continued.Next().has_value());
  } catch (const JournalError&) {
  } catch (const WriteError&) {
  }
}

}  // namespace

/// Any bytes as a journal, and as alterations of one that is sound: never a crash, never an end
/// that does not come, never an exception but JournalError and WriteError; and one that can be
/// continued keeps what can be read, and tells of the rest.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const InputFile kFile("fuzz.db");
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.starts_with("SQLite")) {
    TryJournal(kFile, bytes);
  } else {
    TryJournal(kFile, Altered(bytes));
  }
  return 0;
}
