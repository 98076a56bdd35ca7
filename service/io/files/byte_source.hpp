// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <span>
#include <string>

namespace qwsm::io {

/// The bytes of a stream, decompressed where they begin like gzip, bzip2, xz or zstd.
class ByteSource {
 public:
  /// Looks at the first bytes of `stream`, which must outlive this.
  explicit ByteSource(std::istream& stream);
  ByteSource(ByteSource&&) noexcept;
  ~ByteSource();

  /// Fills the front of `buffer` and returns how many bytes that are; 0 only at the end.
  /// @throws std::runtime_error where the archive is truncated or corrupt, after what was good
  ///         before has been returned.
  std::size_t Read(std::span<char> buffer);

  /// "none", "gzip", "bzip2", "xz" or "zstd".
  const std::string& compression() const;

  /// Bytes taken from the stream, of the compressed form.
  std::uint64_t bytes_read() const;

 private:
  class Input;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace qwsm::io
