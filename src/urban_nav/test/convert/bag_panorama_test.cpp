// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/bag_panorama.hpp"

#include <gtest/gtest.h>

#include "convert/convert.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/bags.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::StampNs;
using urban_nav_input::BagEnd;
using urban_nav_input::openSource;
using urban_nav_input::Source;
using urban_nav_input::testing::TemporaryFolder;

/// Panoramas of a recording up to its end, or to the end of a bag.
struct PanoramaStamps {
  std::vector<StampNs> stamps;
  std::shared_ptr<const BagEnd> end;

  void add(const std::vector<urban_nav_ros::Panorama>& panoramas) {
    for (const urban_nav_ros::Panorama& panorama : panoramas) {
      stamps.push_back(panorama.stamp);
      ASSERT_EQ(panorama.images.size(), 5U);
      for (std::size_t camera = 0; camera < 5; ++camera) {
        ASSERT_FALSE(panorama.images[camera].empty());
        EXPECT_EQ(panorama.images[camera].grey().pixels.at<std::uint8_t>(0, 0), camera);
      }
    }
  }
};

/// Reads on after `after`, and stops at the end of a bag if asked to.
PanoramaStamps readPanoramas(const std::vector<std::string>& bags, const BagEnd* after, bool stop_at_bag_end) {
  const std::unique_ptr<Source> source = openSource(bags, {}, after);
  EXPECT_EQ(source->info().panorama.size(), 5U);
  PanoramaStamps read;
  while (const auto item = source->next()) {
    if (item->bag_end) {
      read.add(item->bag_end->panoramas);
      read.end = item->bag_end;
      if (stop_at_bag_end) return read;
    }
    read.add(item->panoramas);
  }
  if (const auto end = source->bagEnd()) {
    read.add(end->panoramas);
    read.end = end;
    if (stop_at_bag_end) return read;
  }
  read.add(source->panoramas());
  for (const std::string& fault : source->closingFaults())
    EXPECT_EQ(fault.find("/ladybug"), std::string::npos) << fault;
  return read;
}

TEST(BagPanorama, ResumesAfterEachBagWithTheSamePanoramas) {
  const TemporaryFolder folder;
  urban_nav_input::testing::KittiStyle style;
  style.frames = 12;
  urban_nav_input::testing::makeKittiFolder(folder.file("in"), style);
  Console console;
  convertStereoFolder(folder.file("in"), folder.file("whole.bag"), {}, console);
  const std::vector<std::string> parts = {folder.file("0.bag"), folder.file("1.bag"), folder.file("2.bag")};
  urban_nav_input::testing::splitBag(folder.file("whole.bag"), parts);
  const PanoramaStamps whole = readPanoramas(parts, nullptr, false);
  ASSERT_EQ(whole.stamps.size(), 12U);
  EXPECT_TRUE(std::is_sorted(whole.stamps.begin(), whole.stamps.end()));
  std::vector<StampNs> resumed;
  std::shared_ptr<const BagEnd> end;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const PanoramaStamps some = readPanoramas(parts, end.get(), part + 1 < parts.size());
    resumed.insert(resumed.end(), some.stamps.begin(), some.stamps.end());
    end = some.end;
    ASSERT_TRUE(end) << part;
  }
  EXPECT_EQ(resumed, whole.stamps);
}

}  // namespace
}  // namespace urban_nav
