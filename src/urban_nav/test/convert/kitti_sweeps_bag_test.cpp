// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "convert/convert.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_input::SweepInput;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_input::testing::writeFile;

constexpr int kSweepCount = 8;

/// A folder of KITTI with sweeps of a round room and no images. `name`: velodyne or velodyne_points/data.
void writeSweepFolder(const std::string& folder, const std::string& name) {
  constexpr int kBeamRings = 16, kBeamColumns = 180;
  std::string times;
  for (int i = 0; i < kSweepCount; ++i) {
    std::string bytes;
    for (int ring = kBeamRings - 1; ring >= 0; --ring)
      for (int column = 0; column < kBeamColumns; ++column) {
        const double azimuth = 2.0 * M_PI * (column + 0.5) / kBeamColumns, range = 8.0 + std::cos(3.0 * azimuth);
        const float point[] = {static_cast<float>(range * std::cos(azimuth)),
                               static_cast<float>(range * std::sin(azimuth)),
                               static_cast<float>(range * std::tan((2.0 * ring - 20.0) * M_PI / 180.0)), 0.25F};
        bytes.append(reinterpret_cast<const char*>(point), sizeof(point));
      }
    writeFile(folder + "/" + name + "/00000" + std::to_string(i) + ".bin", bytes);
    times += std::to_string(0.1 * i + 5.0) + "\n";
  }
  writeFile(folder + "/times.txt", times);
  writeFile(folder + "/calib.txt", "Tr: 0 -1 0 0.1 0 0 -1 -0.2 1 0 0 -0.3\n");
}

std::vector<SweepInput> readSweeps(const std::string& input, std::optional<bool> deskewed = std::nullopt) {
  urban_nav_input::SourceOptions options;
  options.with_sweeps = true;
  options.points.deskewed = deskewed;
  const auto source = urban_nav_input::openSource({input}, options);
  std::vector<SweepInput> sweeps;
  while (auto item = source->next())
    for (SweepInput& sweep : item->sweeps) sweeps.push_back(std::move(sweep));
  for (SweepInput& sweep : source->sweeps()) sweeps.push_back(std::move(sweep));
  return sweeps;
}

void expectSameSweeps(const std::vector<SweepInput>& a, const std::vector<SweepInput>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].sweep.beams.size(), b[i].sweep.beams.size());
    const urban_nav_core::StampNs shift = b[0].sweep.reference - a[0].sweep.reference;
    EXPECT_EQ(b[i].sweep.reference - a[i].sweep.reference, shift);
    for (std::size_t k = 0; k < a[i].sweep.beams.size(); ++k) {
      const urban_nav_core::Beam &of_a = a[i].sweep.beams[k], &of_b = b[i].sweep.beams[k];
      ASSERT_EQ(of_a.range, of_b.range);
      ASSERT_EQ(of_a.direction, of_b.direction);
      ASSERT_EQ(of_a.ring, of_b.ring);
      ASSERT_NEAR(static_cast<double>(of_b.stamp - shift - of_a.stamp), 0.0, 1000.0) << "ns";
    }
  }
}

TEST(KittiSweepsBag, SweepsOfABagAreThoseOfTheFolder) {
  const TemporaryFolder folder;
  Console console;
  writeSweepFolder(folder.file("raw"), "velodyne_points/data");
  const Converted converted = convertStereoFolder(folder.file("raw"), folder.file("raw.bag"), {}, console);
  EXPECT_EQ(converted.counts.at("/points"), kSweepCount);
  EXPECT_EQ(converted.counts.count("/stereo/left/image_raw"), 0U) << "the folder has none";
  for (const std::string& note : converted.notes) EXPECT_EQ(note.find("not used"), std::string::npos) << note;
  const std::vector<SweepInput> sweeps = readSweeps(folder.file("raw.bag"));
  ASSERT_EQ(sweeps.size(), std::size_t{kSweepCount});
  expectSameSweeps(readSweeps(folder.file("raw")), sweeps);
}

TEST(KittiSweepsBag, DeskewedSweepsHaveNoTimesAndANoteStatesIt) {
  const TemporaryFolder folder;
  Console console;
  writeSweepFolder(folder.file("deskewed"), "velodyne");
  const Converted converted = convertStereoFolder(folder.file("deskewed"), folder.file("deskewed.bag"), {}, console);
  bool is_stated = false;
  for (const std::string& note : converted.notes)
    is_stated = is_stated || note.find("input.points_deskewed=yes") != std::string::npos;
  EXPECT_TRUE(is_stated);
  const std::vector<SweepInput> sweeps = readSweeps(folder.file("deskewed.bag"), true);
  ASSERT_EQ(sweeps.size(), std::size_t{kSweepCount});
  for (const SweepInput& sweep : sweeps)
    for (const urban_nav_core::Beam& beam : sweep.sweep.beams) ASSERT_EQ(beam.stamp, sweep.sweep.reference);
}

TEST(KittiSweepsBag, ADamagedSweepIsNamedAndLeavesNoBag) {
  const TemporaryFolder folder;
  Console console;
  writeSweepFolder(folder.file("raw"), "velodyne_points/data");
  writeFile(folder.file("raw/velodyne_points/data/000003.bin"), "short");
  try {
    convertStereoFolder(folder.file("raw"), folder.file("raw.bag"), {}, console);
    FAIL() << "a damaged sweep must end a conversion";
  } catch (const urban_nav_core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find("000003.bin"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder.file("raw.bag")));
}

}  // namespace
}  // namespace urban_nav
