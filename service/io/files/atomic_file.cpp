// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <streambuf>
#include <string>
#include <system_error>
#include <utility>

#include "service/io/files/link_target.hpp"

namespace qwsm::io {
namespace {

namespace fs = std::filesystem;

std::string Reason(int error_number) { return std::generic_category().message(error_number); }

WriteError CannotWrite(const std::filesystem::path& path, int error_number) {
  return WriteError(path.string() + ": cannot be written: " + Reason(error_number));
}

/// Whether what stands at a path takes bytes one after the other and cannot be replaced.
/// @throws WriteError where what stands there is nothing to write to.
bool IsStream(const fs::path& path) {
  std::error_code ignored;
  switch (fs::status(path, ignored).type()) {
    case fs::file_type::fifo:
    case fs::file_type::character:
      return true;
    case fs::file_type::directory:
      throw CannotWrite(path, EISDIR);
    case fs::file_type::block:
    case fs::file_type::socket:
      throw WriteError(path.string() + ": cannot be written: is neither a file nor a pipe");
    default:
      return false;
  }
}

/// Where to write until all is there.
fs::path TemporaryPathOf(const fs::path& path, const fs::path& target) {
  return IsStream(path) ? path : fs::path(target.string() + ".part");
}

}  // namespace

/// Unlike std::filebuf, remembers why a write failed.
class AtomicFile::FileBuffer : public std::streambuf {
 public:
  explicit FileBuffer(const std::filesystem::path& path)
      : descriptor_(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) error_number_ = errno;
    setp(bytes_.data(), bytes_.data() + bytes_.size());
  }
  FileBuffer(const FileBuffer&) = delete;
  FileBuffer& operator=(const FileBuffer&) = delete;
  ~FileBuffer() override { Close(); }

  int error_number() const { return error_number_; }

  /// Bytes on the disk, not just on their way: a rename must not overtake them.
  void Synchronize() {
    Flush();
    if (error_number_ == 0 && fsync(descriptor_) != 0 && errno != EINVAL) error_number_ = errno;
  }

  void Close() {
    if (descriptor_ < 0) return;
    if (close(descriptor_) != 0 && error_number_ == 0) error_number_ = errno;
    descriptor_ = -1;
  }

 protected:
  int_type overflow(int_type c) override {
    Flush();
    if (error_number_ != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

  int sync() override {
    Flush();
    return error_number_ == 0 ? 0 : -1;
  }

 private:
  void Flush() {
    const char* begin = pbase();
    while (begin < pptr() && error_number_ == 0) {
      const ssize_t written = write(descriptor_, begin, static_cast<std::size_t>(pptr() - begin));
      if (written >= 0) {
        begin += written;
      } else if (errno != EINTR) {
        error_number_ = errno;
      }
    }
    setp(bytes_.data(), bytes_.data() + bytes_.size());
  }

  std::array<char, std::size_t{1} << 16> bytes_;
  int descriptor_;
  int error_number_ = 0;
};

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)),
      target_(TargetOf(path_)),
      temporary_path_(TemporaryPathOf(path_, target_)),
      buffer_(std::make_unique<FileBuffer>(temporary_path_)),
      stream_(buffer_.get()) {
  ThrowIfFailed();
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  if (keeps_unfinished_) stream_.flush();
  buffer_->Close();
  if (keeps_unfinished_ || temporary_path_ == path_) return;
  std::error_code ignored;
  std::filesystem::remove(temporary_path_, ignored);
}

std::ostream& AtomicFile::stream() { return stream_; }

void AtomicFile::ThrowIfFailed() const {
  if (buffer_->error_number() != 0) throw CannotWrite(path_, buffer_->error_number());
}

void AtomicFile::Commit() {
  buffer_->Synchronize();
  buffer_->Close();
  ThrowIfFailed();
  std::error_code error;
  if (temporary_path_ != path_) std::filesystem::rename(temporary_path_, target_, error);
  if (error) throw CannotWrite(path_, error.value());
  committed_ = true;
}

void WriteTextFile(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.stream() << text;
  file.Commit();
}

}  // namespace qwsm::io
