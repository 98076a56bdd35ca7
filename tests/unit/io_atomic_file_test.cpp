// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "service/io/files/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::io {
namespace {

namespace fs = std::filesystem;

std::string ReadFile(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class AtomicFileTest : public ::testing::Test {
 protected:
  bool FolderHoldsOnly(const fs::path& file) const {
    const fs::directory_iterator entries(folder_.path());
    return std::all_of(begin(entries), end(entries), [&](const fs::directory_entry& entry) {
      return entry.path() == file;
    });
  }

  test::TemporaryFolder folder_;
  fs::path file_ = folder_.path() / "result.txt";
};

TEST_F(AtomicFileTest, AppearsWholeWhenCommitted) {
  const std::string text(200'000, 'x');
  AtomicFile file(file_);
  file.stream() << text;
  EXPECT_FALSE(fs::exists(file_));
  file.Commit();
  EXPECT_EQ(ReadFile(file_), text);
  EXPECT_TRUE(FolderHoldsOnly(file_));
}

TEST_F(AtomicFileTest, LeavesTheOldFileWhenGivenUp) {
  WriteTextFile(file_, "old");
  {
    AtomicFile file(file_);
    file.stream() << "new";
  }
  EXPECT_EQ(ReadFile(file_), "old");
  EXPECT_TRUE(FolderHoldsOnly(file_));
}

TEST_F(AtomicFileTest, LeavesWhatCannotBeHadAgain) {
  fs::path unfinished;
  {
    AtomicFile file(file_);
    unfinished = file.KeepUnfinished();
    file.stream() << "as far as it came";
  }
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_EQ(ReadFile(unfinished), "as far as it came");
}

TEST_F(AtomicFileTest, WritesWhatALinkLeadsTo) {
  const fs::path folder = folder_.path() / "elsewhere";
  fs::create_directory(folder);
  fs::create_symlink("elsewhere/other.txt", file_);
  for (const char* text : {"not there yet", "there"}) {
    WriteTextFile(file_, text);
    EXPECT_TRUE(fs::is_symlink(file_));
    EXPECT_EQ(ReadFile(folder / "other.txt"), text);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(AtomicFileTest, WritesToAPipeAndLeavesItThere) {
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  const int reader = open(file_.c_str(), O_RDONLY | O_NONBLOCK);
  WriteTextFile(file_, "text");
  { const AtomicFile given_up(file_); }
  std::array<char, 8> bytes{};
  EXPECT_EQ(read(reader, bytes.data(), bytes.size()), 4);
  EXPECT_STREQ(bytes.data(), "text");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(file_));
  EXPECT_TRUE(FolderHoldsOnly(file_));
}

TEST_F(AtomicFileTest, RefusesWhatIsNoFileBeforeAnythingIsWritten) {
  fs::create_directory(file_);
  EXPECT_THROW(AtomicFile{file_}, WriteError);
  EXPECT_TRUE(FolderHoldsOnly(file_));
}

TEST_F(AtomicFileTest, SaysWhyItCannotBeWritten) {
  const fs::path nowhere = folder_.path() / "none" / "result.txt";
  try {
    AtomicFile file(nowhere);
    FAIL();
  } catch (const WriteError& error) {
    EXPECT_EQ(std::string(error.what()),
              nowhere.string() + ": cannot be written: No such file or directory");
  }
}

TEST_F(AtomicFileTest, SaysThatTheDiskIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  fs::create_symlink("/dev/full", file_.string() + ".part");
  AtomicFile file(file_);
  file.stream() << std::string(200'000, 'x');
  EXPECT_THROW(file.ThrowIfFailed(), WriteError) << "known before the end";
  try {
    file.Commit();
    FAIL();
  } catch (const WriteError& error) {
    EXPECT_EQ(std::string(error.what()),
              file_.string() + ": cannot be written: No space left on device");
  }
  EXPECT_FALSE(fs::exists(file_));
}

}  // namespace
}  // namespace qwsm::io
