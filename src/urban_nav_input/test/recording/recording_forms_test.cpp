// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "storage/recording_samples.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

namespace fs = std::filesystem;
using testing::Contents;

/// Returns the folder of recordings by other programs; empty without URBAN_NAV_DATA.
std::string findRecordings() {
  const char* data = std::getenv("URBAN_NAV_DATA");
  const std::string folder = data == nullptr ? std::string() : std::string(data) + "/recordings";
  return fs::exists(folder + "/session.tar.xz") ? folder : std::string();
}

TEST(RecordingForms, EveryMemberOfEveryMessageIsThatOfTheBag) {
  if (findRecordings().empty()) GTEST_SKIP() << "URBAN_NAV_DATA has no recordings/session.tar.xz";
  const testing::TemporaryFolder folder;
  const std::string unpack = "tar -xf '" + findRecordings() + "/session.tar.xz' -C '" + folder.file("") + "'";
  ASSERT_EQ(std::system(unpack.c_str()), 0);
  const Contents bag = testing::readContents(folder.file("session/session.bag"));
  ASSERT_EQ(bag.size(), 11U);
  for (const char* form :
       {"none.mcap", "zstd.mcap", "lz4.mcap", "ros1.mcap", "apart.mcap", "sqlite", "sqlite/sqlite_0.db3", "files"}) {
    const std::string path = folder.file("session") + "/" + form;
    EXPECT_TRUE(testing::readContents(path) == bag) << form;
    EXPECT_TRUE(Recording(path).warnings().empty()) << form;
  }
}

TEST(RecordingForms, BagsOfRosbag2OpenInBothStoragesWithEqualMessages) {
  if (findRecordings().empty()) GTEST_SKIP() << "URBAN_NAV_DATA has no recordings";
  for (const char* name : {"talker", "wbag", "cdr_test", "service_events", "wrong_rmw_test"}) {
    const std::string path = findRecordings() + "/rosbag2/" + name;
    Recording sqlite(path + "_sqlite3"), mcap(path + "_mcap");
    std::size_t messages = 0;
    for (const auto& [topic, type] : mcap.topicTypes()) {
      if (mcap.count(topic) == 0) continue;
      EXPECT_EQ(sqlite.topicTypes()[topic], type) << topic;
      EXPECT_EQ(mcap.undecoded(topic).empty(), std::string(name) != "wrong_rmw_test") << mcap.undecoded(topic);
      MessageSelection a = sqlite.select(std::vector<std::string>{topic});
      MessageSelection b = mcap.select(std::vector<std::string>{topic});
      ASSERT_EQ(a.size(), b.size()) << topic;
      messages += a.size();
      if (std::string(name) == "service_events") continue;  // recorded twice
      while (const std::optional<RecordedMessage> one = a.next()) {
        const ByteView other = b.next()->bytes(), bytes = one->bytes();
        ASSERT_EQ(std::string(bytes.data, bytes.data + bytes.size), std::string(other.data, other.data + other.size));
      }
    }
    EXPECT_GT(messages, 6U) << name;
  }
}

}  // namespace
}  // namespace urban_nav_input
