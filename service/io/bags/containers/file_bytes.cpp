// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/containers/file_bytes.hpp"

#include <algorithm>

#include "service/io/files/file_error.hpp"

namespace qwsm::io {
namespace {

constexpr std::size_t kWindowBytes = 1 << 18;

}  // namespace

FileBytes::FileBytes(const std::filesystem::path& path)
    : file_(OpenForReading(path)), size_(std::filesystem::file_size(path)) {}

std::string_view FileBytes::At(std::uint64_t offset, std::size_t size) {
  if (offset >= size_) return {};
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(size, size_ - offset));
  if (offset < window_begin_ || offset + wanted > window_begin_ + window_.size()) {
    window_begin_ = offset;
    window_.resize(static_cast<std::size_t>(
        std::min<std::uint64_t>(std::max(wanted, kWindowBytes), size_ - offset)));
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(offset));
    file_.read(window_.data(), static_cast<std::streamsize>(window_.size()));
    window_.resize(static_cast<std::size_t>(file_.gcount()));  // Who cuts it off now?
  }
  return std::string_view(window_).substr(static_cast<std::size_t>(offset - window_begin_), wanted);
}

}  // namespace qwsm::io
