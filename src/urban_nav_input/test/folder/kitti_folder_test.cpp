// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/kitti_layout.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

using testing::KittiStyle;
using testing::readFile;
using testing::TemporaryFolder;
using testing::writeFile;
using urban_nav_core::UserError;

std::vector<SourceItem> all(Source& source) {
  std::vector<SourceItem> inputs;
  while (std::optional<SourceItem> input = source.next()) inputs.push_back(std::move(*input));
  return inputs;
}

std::string catchMessage(const std::function<void()>& call) {
  try {
    call();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(KittiFolder, ReadsEachLayout) {
  for (const auto& [left, right, digits] : {std::tuple("image_0", "image_1", 6), std::tuple("image_00", "image_01", 10),
                                            std::tuple("image_00/data", "image_01/data", 10)}) {
    const TemporaryFolder folder;
    KittiStyle style;
    style.left = left;
    style.right = right;
    style.digits = digits;
    style.frames = 3;
    testing::makeKittiFolder(folder.file("in"), style);
    const auto source = openKittiFolder(folder.file("in"), {});
    EXPECT_EQ(source->info().frames, 3) << left;
    EXPECT_EQ(source->info().camera.left.width, 240);
    EXPECT_NEAR(source->info().camera.baseline, 0.12, 1e-9);
    const std::vector<SourceItem> inputs = all(*source);
    ASSERT_EQ(inputs.size(), 3U) << left;
    EXPECT_EQ(inputs[1].assembled.pair.stamp, 50'000'000);
    for (const SourceItem& input : inputs) {
      EXPECT_TRUE(input.faults.empty());
      EXPECT_EQ(input.assembled.pair.left.width, 240);
      EXPECT_EQ(input.assembled.pair.right.height, 180);
    }
  }
}

TEST(KittiFolder, NamesWhatIsNotUsed) {
  const TemporaryFolder folder;
  KittiStyle style;
  style.frames = 2;
  style.left = "image_00/data";
  style.right = "image_01/data";
  testing::makeKittiFolder(folder.file("in"), style);
  const auto unused = [&folder] {
    const auto source = openKittiFolder(folder.file("in"), {});
    for (const std::string& note : source->info().notes)
      if (note.rfind("not used", 0) == 0) return note;
    return std::string();
  };
  EXPECT_EQ(unused(), "");
  std::filesystem::create_directories(folder.file("in") + "/velodyne_points");
  writeFile(folder.file("in") + "/oxts.txt", "0");
  writeFile(folder.file("in") + "/.hidden", "0");
  EXPECT_EQ(unused(), "not used: oxts.txt, velodyne_points/");
  for (int i = 0; i < 20; ++i) writeFile(folder.file("in") + "/a" + std::to_string(10 + i), "");
  EXPECT_EQ(unused(), "not used: a10, a11, a12, a13, a14, a15, a16, a17 and 14 more");
}

TEST(KittiFolder, ReadsADriveOfKitti360) {
  const TemporaryFolder folder;
  const std::string drive = folder.file("data_2d_raw") + "/2013_05_28_drive_0000_sync";
  KittiStyle style;
  style.left = "image_00/data_rect";
  style.right = "image_01/data_rect";
  style.digits = 10;
  style.frames = 2;
  std::filesystem::create_directories(drive);
  testing::makeKittiFolder(drive, style);
  std::string calibration = readFile(drive + "/calib.txt");
  for (const char side : {'0', '1'})
    calibration.replace(calibration.find(std::string("P") + side + ":"), 3, std::string("P_rect_0") + side + ":");
  std::filesystem::remove(drive + "/calib.txt");
  std::filesystem::create_directory(folder.file("calibration"));
  writeFile(folder.file("calibration") + "/perspective.txt", "calib_time: 10-Sep-2013 12:00:00\n" + calibration);
  for (const char* end : {"", "/"}) {
    const auto source = openKittiFolder(drive + end, {});
    EXPECT_NEAR(source->info().camera.baseline, 0.12, 1e-9);
    EXPECT_EQ(all(*source).size(), 2U);
  }
}

TEST(KittiFolder, TakesStampsFromRawTimestampsAndRates) {
  const TemporaryFolder folder;
  KittiStyle style;
  style.left = "image_00/data";
  style.right = "image_01/data";
  style.times = false;
  style.frames = 2;
  testing::makeKittiFolder(folder.file("in"), style);
  SourceOptions options;
  options.rate = 4.0;
  EXPECT_EQ(openKittiFolder(folder.file("in"), options)->info().last, 250'000'000);
  EXPECT_EQ(openKittiFolder(folder.file("in"), {})->info().last, 100'000'000) << "KITTI's cameras run at 10 Hz";
  writeFile(folder.file("in/image_00/timestamps.txt"),
            "2011-09-26 13:02:25.964389445\n2011-09-26 13:02:26.067389445\n");
  EXPECT_EQ(openKittiFolder(folder.file("in"), {})->info().first, 1317042145964389445);
}

TEST(KittiFolder, NamesAnImageThatIsTruncatedMissingOrOfAnotherSize) {
  const TemporaryFolder folder;
  KittiStyle style;
  style.frames = 4;
  testing::makeKittiFolder(folder.file("in"), style);
  const std::string whole = readFile(folder.file("in/image_0/000001.png"));
  writeFile(folder.file("in/image_0/000001.png"), whole.substr(0, whole.size() / 2));
  std::filesystem::remove(folder.file("in/image_1/000002.png"));
  const std::vector<SourceItem> inputs = all(*openKittiFolder(folder.file("in"), {}));
  ASSERT_EQ(inputs.size(), 4U);
  ASSERT_EQ(inputs[1].faults.size(), 1U);
  EXPECT_NE(inputs[1].faults[0].find("image_0/000001.png"), std::string::npos);
  EXPECT_TRUE(inputs[1].assembled.pair.left.empty());
  EXPECT_FALSE(inputs[1].assembled.pair.right.empty());
  ASSERT_EQ(inputs[2].faults.size(), 1U);
  EXPECT_NE(inputs[2].faults[0].find("image_1"), std::string::npos);
  EXPECT_TRUE(inputs[3].faults.empty());
}

TEST(KittiFolder, NamesFileAndLineOfWhatIsWrong) {
  const TemporaryFolder folder;
  KittiStyle style;
  style.frames = 3;
  testing::makeKittiFolder(folder.file("in"), style);
  const auto open = [&] { openKittiFolder(folder.file("in"), {}); };
  writeFile(folder.file("in/times.txt"), "0.0\nsoon\n0.2\n");
  EXPECT_NE(catchMessage(open).find("times.txt:2"), std::string::npos) << catchMessage(open);
  writeFile(folder.file("in/times.txt"), "0.0\n0.1\n");
  EXPECT_NE(catchMessage(open).find("2 stamps"), std::string::npos) << catchMessage(open);
  std::filesystem::remove(folder.file("in/times.txt"));
  std::filesystem::create_directory(folder.file("in/times.txt"));
  EXPECT_EQ(catchMessage(open), folder.file("in/times.txt") + ": is a folder: expected a text file");
  std::filesystem::remove(folder.file("in/times.txt"));
  writeFile(folder.file("in/calib.txt"), "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nP1: 1 0 0 zero 0 1 0 0 0 0 1 0\n");
  EXPECT_NE(catchMessage(open).find("calib.txt:2"), std::string::npos) << catchMessage(open);
  writeFile(folder.file("in/calib.txt"), "P0: 200 0 100 0 0 200 90 0 0 0 1 0\nP1: 200 0 100 20 0 200 90 0 0 0 1 0\n");
  EXPECT_NE(catchMessage(open).find("baseline"), std::string::npos)
      << "right camera to the left: " << catchMessage(open);
  std::filesystem::remove(folder.file("in/calib.txt"));
  EXPECT_NE(catchMessage(open).find("calib.txt"), std::string::npos);
}

TEST(KittiFolder, TakesTheCalibrationOfTheUser) {
  const TemporaryFolder folder;
  KittiStyle style;
  style.frames = 2;
  testing::makeKittiFolder(folder.file("in"), style);
  const auto own = openKittiFolder(folder.file("in"), {});
  std::filesystem::rename(folder.file("in/calib.txt"), folder.file("calib.txt"));
  SourceOptions options;
  options.calibration = folder.file("calib.txt");
  const auto given = openKittiFolder(folder.file("in"), options);
  EXPECT_EQ(given->info().camera.baseline, own->info().camera.baseline);
  EXPECT_EQ(given->info().camera.left.fx, own->info().camera.left.fx);
  writeFile(folder.file("in/calib.txt"), "P0: 9 0 9 0 0 9 9 0 0 0 1 0\nP1: 9 0 9 -9 0 9 9 0 0 0 1 0\n");
  EXPECT_EQ(openKittiFolder(folder.file("in"), options)->info().camera.left.fx, own->info().camera.left.fx)
      << "what the user says stands above what the folder has";
}

TEST(KittiFolder, HasNoOtherMeasurementOfTheMotionAndNoTopics) {
  const TemporaryFolder folder;
  KittiStyle style;
  style.frames = 2;
  testing::makeKittiFolder(folder.file("in"), style);
  SourceOptions options;
  EXPECT_NO_THROW(openSource({folder.file("in")}, options));
  options.motion_input = "gyroscope";
  EXPECT_THROW(openSource({folder.file("in")}, options), urban_nav_core::DataError);
  options = {};
  options.topics = {"left:=/cam0/image_raw"};
  EXPECT_THROW(openSource({folder.file("in")}, options), urban_nav_core::UserError);
}

std::string cameraYaml(double shift, double distortion, int width = 240) {
  return "image_width: " + std::to_string(width) +
         "\nimage_height: 180\n"
         "camera_matrix: {rows: 3, cols: 3, data: [200, 0, 120, 0, 200, 90, 0, 0, 1]}\n"
         "distortion_model: plumb_bob\n"
         "distortion_coefficients: {rows: 1, cols: 5, data: [" +
         std::to_string(distortion) +
         ", 0, 0, 0, 0]}\n"
         "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
         "projection_matrix: {rows: 3, cols: 4, data: [200, 0, 120, " +
         std::to_string(shift) + ", 0, 200, 90, 0, 0, 0, 1, 0]}\n";
}

TEST(KittiFolder, RectifiesByTheCalibrationOfTheUser) {
  const TemporaryFolder folder;
  KittiStyle style;
  style.frames = 1;
  testing::makeKittiFolder(folder.file("in"), style);
  SourceOptions options;
  options.calibration = folder.file("left.yaml") + "," + folder.file("right.yaml");
  const auto findFirst = [&](double distortion) {
    writeFile(folder.file("left.yaml"), cameraYaml(0.0, distortion));
    writeFile(folder.file("right.yaml"), cameraYaml(-24.0, distortion));
    return all(*openKittiFolder(folder.file("in"), options)).front();
  };
  const SourceItem plain = findFirst(0.0), bent = findFirst(-0.2);
  ASSERT_FALSE(plain.assembled.pair.left.empty());
  ASSERT_FALSE(bent.assembled.pair.left.empty());
  int centre = 0, corner = 0;
  for (int k = 0; k < 20; ++k) {
    centre += std::abs(plain.assembled.pair.left.at(110 + k, 90) - bent.assembled.pair.left.at(110 + k, 90));
    corner += std::abs(plain.assembled.pair.left.at(k, 5) - bent.assembled.pair.left.at(k, 5));
  }
  EXPECT_LT(centre, corner) << "a lens bends the border";
  EXPECT_GT(corner, 0);
  writeFile(folder.file("left.yaml"), cameraYaml(0.0, 0.0, 320));
  writeFile(folder.file("right.yaml"), cameraYaml(-24.0, 0.0, 320));
  EXPECT_NE(catchMessage([&] { openKittiFolder(folder.file("in"), options); }).find("320x180"), std::string::npos);
}

TEST(KittiLayout, ParsesDates) {
  EXPECT_EQ(parseDateTime("1970-01-01 00:00:01.5"), 1'500'000'000);
  EXPECT_EQ(parseDateTime("2000-02-29T12:00:00.000000001"), 951825600000000001);
  EXPECT_FALSE(parseDateTime("2011-13-26 13:02:25.9"));
  EXPECT_FALSE(parseDateTime("yesterday"));
}

TEST(InputKind, ReportsTheExpectedKinds) {
  const TemporaryFolder folder;
  writeFile(folder.file("text.bag"), "no bag");
  std::filesystem::create_directories(folder.file("empty"));
  EXPECT_NE(catchMessage([&] { inputKind(folder.file("text.bag")); }).find("is not a recording"), std::string::npos);
  EXPECT_NE(catchMessage([&] { inputKind(folder.file("empty")); }).find("KITTI"), std::string::npos);
  EXPECT_NE(catchMessage([&] { inputKind(folder.file("nowhere")); }).find("does not exist"), std::string::npos);
}

}  // namespace
}  // namespace urban_nav_input
