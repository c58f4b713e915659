// SPDX-License-Identifier: BSD-3-Clause
// Files that once did harm (corpus/README.md) are read again: they are refused, or read as far as they are whole.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/testing/limited_memory.hpp"
#include "urban_nav_core/testing/peak_memory.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/image_file.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMemory = std::size_t{64} << 20U;
constexpr double kOther = 64e6;  // bytes: of the libraries' own, and of the allocator

/// Returns the number of messages, images or points that are read; 0 for a file that is refused.
std::size_t countRead(const fs::path& path) {
  try {
    if (isImageName(path.string())) return readPixels(path.string()).pixels.empty() ? 0 : 1;
    if (path.extension() != ".bag" && path.extension() != ".mcap")
      return urban_nav_core::readCloud(path.string()).cloud.points.size();
    Recording recording(path.string());
    MessageSelection messages = recording.select(std::nullopt);
    std::size_t count = 0;
    while (const std::optional<RecordedMessage> message = messages.next())
      if (message->bytes().data != nullptr) ++count;
    return count;
  } catch (const urban_nav_core::Error& error) {
    EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos) << error.what();
    return 0;
  }
}

TEST(Corpus, FilesThatDidHarmAreRefusedOrReadAsFarAsTheyAreWhole) {
  const urban_nav_core::testing::LimitedMemory limit(kMemory);
  // Read by their records, in which nothing is damaged but the index.
  const std::set<std::string> whole = {"fields_of_4_GB.bag", "message_beyond_its_chunk.bag",
                                       "same_chunk_100_times.bag"};
  std::size_t files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator("test/corpus")) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md") continue;
    ++files;
    std::size_t count = 0;
    const double grown = urban_nav_core::testing::measureMemory([&] { count = countRead(entry.path()); });
    EXPECT_LE(grown, static_cast<double>(kMemory) + kOther) << name;
    EXPECT_EQ(count, whole.count(name) > 0 ? 3U : 0U) << name;
  }
  EXPECT_GE(files, 16U);
}

}  // namespace
}  // namespace urban_nav_input
