// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <stdexcept>

#include "io/reader_check.hpp"
#include "urban_nav_core/io/text_file.hpp"

namespace urban_nav_core {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::Test {
 protected:
  AtomicFileTest() : folder_(fs::temp_directory_path() / ("urban_nav_atomic_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~AtomicFileTest() override { fs::remove_all(folder_); }
  std::size_t files() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_)) ++count;
    return count;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  fs::path folder_;
};

TEST_F(AtomicFileTest, AppearsWholeAtCommit) {
  AtomicFile file(path("a.txt"));
  file.write("one ");
  EXPECT_FALSE(fs::exists(path("a.txt")));
  file.write(std::string(200000, 'x'));
  file.commit();
  EXPECT_EQ(readTextFile(path("a.txt")), "one " + std::string(200000, 'x'));
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, LeavesTheOldFileWhenSomethingIsThrown) {
  writeAtomically(path("a.txt"), "old");
  try {
    AtomicFile file(path("a.txt"));
    file.write(std::string(200000, 'x'));
    throw std::runtime_error("the source ended");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(readTextFile(path("a.txt")), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, AnotherWritersFileIsRenamedOrRemoved) {
  {
    PartialFile partial(path("a.bag"));
    EXPECT_EQ(fs::path(partial.path()).extension(), ".bag");
    EXPECT_EQ(fs::path(partial.path()).parent_path(), folder_);
    writeAtomically(partial.path(), "half");
  }
  EXPECT_EQ(files(), 0U);
  PartialFile partial(path("a.bag"));
  writeAtomically(partial.path(), "whole");
  partial.commit();
  EXPECT_EQ(readTextFile(path("a.bag")), "whole");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, NamesThePathThatCannotBeWritten) {
  const std::string nowhere = path("no/such/folder/a.txt");
  EXPECT_EQ(catchError([&] { writeAtomically(nowhere, "x"); }),
            nowhere + ": cannot be written: No such file or directory");
  fs::create_directories(path("folder"));
  EXPECT_EQ(catchError([&] { writeAtomically(path("folder"), "x"); }),
            path("folder") + ": cannot be written: Is a directory");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, AFullDiskIsAnErrorAndNoFile) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  fs::create_symlink("/dev/full", path("a.part.txt"));
  EXPECT_EQ(catchError([&] { writeAtomically(path("a.txt"), "x"); }),
            path("a.txt") + ": cannot be written: No space left on device");
  fs::create_symlink("/dev/full", path("a.part.txt"));
  EXPECT_THROW(writeAtomically(path("a.txt"), "x"), DataError) << "not a UserError";
  EXPECT_FALSE(fs::exists(path("a.txt")));
}

TEST_F(AtomicFileTest, ALinkStaysALink) {
  writeAtomically(path("a.txt"), "old");
  fs::create_symlink("a.txt", path("link.txt"));
  writeAtomically(path("link.txt"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link.txt")));
  EXPECT_EQ(readTextFile(path("a.txt")), "new");
  EXPECT_EQ(files(), 2U);
}

TEST_F(AtomicFileTest, APipeIsWrittenAndNotReplaced) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const int reader = ::open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  writeAtomically(path("pipe"), "said");
  std::array<char, 16> received{};
  EXPECT_EQ(::read(reader, received.data(), received.size()), 4);
  ::close(reader);
  EXPECT_STREQ(received.data(), "said");
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, AnotherWriterIsGivenNoPipe) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(catchError([&] { const PartialFile partial(path("pipe")); }),
            path("pipe") + ": is a device or a pipe: expected a file");
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

}  // namespace
}  // namespace urban_nav_core
