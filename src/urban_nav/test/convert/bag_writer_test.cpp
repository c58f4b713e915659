// SPDX-License-Identifier: BSD-3-Clause
#include "convert/bag_writer.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

namespace fs = std::filesystem;
using urban_nav_core::UserError;
using urban_nav_input::testing::TemporaryFolder;

constexpr urban_nav_core::StampNs kSecond = 1'000'000'000;

TEST(BagWriter, ABagThatIsNotCommittedLeavesNothing) {
  const TemporaryFolder folder;
  {
    BagWriter bag(folder.file("a.bag"));
    bag.write("/pose", kSecond, geometry_msgs::PoseStamped());
    EXPECT_TRUE(fs::exists(folder.file("a.bag.active")));
  }
  EXPECT_TRUE(fs::is_empty(folder.file("")));
}

TEST(BagWriter, AFullDiskIsAnErrorAndNoBag) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const TemporaryFolder folder;
  for (const int messages : {1, 20000}) {
    fs::create_symlink("/dev/full", folder.file("a.bag.active"));
    const auto write = [&] {
      BagWriter bag(folder.file("a.bag"));
      for (int i = 0; i < messages; ++i) bag.write("/pose", kSecond, geometry_msgs::PoseStamped());
      bag.commit();
    };
    EXPECT_THROW(write(), UserError) << messages << " messages";
    EXPECT_TRUE(fs::is_empty(folder.file(""))) << messages << " messages";
  }
}

}  // namespace
}  // namespace urban_nav
