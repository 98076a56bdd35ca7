// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "service/io/clouds/scan_points.hpp"

namespace slam6d::io {

/// Numbers as files hold them, little endian.
enum class NumberType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64
};

std::size_t SizeOf(NumberType type);

/// Where one record holds x, y and z.
struct RecordLayout {
  struct Field {
    std::size_t offset = 0;  ///< Place in a binary record, in bytes.
    std::size_t column = 0;  ///< Place in a record that is a line of text, counted from 0.
    NumberType type = NumberType::kFloat32;
  };
  std::array<std::optional<Field>, 3> xyz;
  std::size_t bytes = 0;  ///< Length of a binary record.
  std::size_t columns = 0;

  /// Appends a field of `count` numbers; those called x, y and z are remembered.
  void Add(std::string_view name, NumberType type, std::size_t count = 1);
  /// Checks that x, y and z are there.
  /// @throws std::runtime_error naming the file where a coordinate is missing, or where there are
  /// absurdly many columns.
  void Check(const std::filesystem::path& file) const;
};

/// A header and the bytes behind it, of a file being taken apart.
struct RecordFile {
  std::filesystem::path path;
  std::string bytes;     ///< All of the file, unpacked.
  std::size_t at = 0;    ///< Where the rest of the file begins.
  std::size_t line = 0;  ///< Lines taken so far.

  /// Reads a file. @throws std::runtime_error naming it when it cannot be read.
  explicit RecordFile(const std::filesystem::path& file);

  /// The next line of text; nothing at the end.
  std::optional<std::string_view> NextLine();
  /// A number of points or the like, as the header has it; Fail() where it is none.
  std::size_t Count(std::string_view word) const;
  /// Text of a problem here: "file:line: what".
  std::string Problem(const std::string& what) const;
  /// Throws the Problem() as std::runtime_error.
  [[noreturn]] void Fail(const std::string& what) const;
};

/// Takes `count` records; fewer in the file are a problem that is kept with what is there.
void TakeBinary(RecordFile& file,
                const RecordLayout& layout,
                std::size_t count,
                ScanPoints& points);
void TakeText(RecordFile& file, const RecordLayout& layout, std::size_t count, ScanPoints& points);

/// Reads a `.bin` of the KITTI benchmarks: x y z intensity as 32-bit floats, in metres.
ScanPoints ReadKittiPoints(const std::filesystem::path& file);

}  // namespace slam6d::io
