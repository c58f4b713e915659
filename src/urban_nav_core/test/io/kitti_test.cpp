// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/kitti.hpp"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "io/reader_check.hpp"
#include "urban_nav_core/io/text_file.hpp"

namespace urban_nav_core {
namespace {

std::vector<Pose> somePoses() {
  std::vector<Pose> poses;
  for (int i = 0; i < 20; ++i)
    poses.emplace_back(expSo3({0.1 * i, -0.2, 0.03 * i * i}), Vector3d(i, 0.1, -3.0 / (i + 1)));
  return poses;
}

TEST(Kitti, MatricesRoundTripExactly) {
  const std::string text = printKitti(somePoses());
  EXPECT_EQ(printKitti(parseKittiMatrices(text, "p.txt")), text);
}

TEST(Kitti, PosesRoundTripToRounding) {
  const auto poses = somePoses();
  const auto back = parseKitti(printKitti(poses), "p.txt");
  ASSERT_EQ(back.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(back[i].t(), poses[i].t());
    EXPECT_TRUE(isApprox(back[i], poses[i], 2e-15));
  }
}

TEST(Kitti, ReadsTheFormOfTheBenchmark) {
  const auto poses = parseKitti(
      "1.000000e+00 9.043680e-12 2.326809e-11 5.551115e-17 9.043683e-12 1.000000e+00 2.392370e-10 3.330669e-16 "
      "2.326810e-11 2.392370e-10 9.999999e-01 -4.440892e-16\n\n0 -1 0 1 1 0 0 2 0 0 1 3\n",
      "p.txt");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_TRUE(isApprox(poses[0], Pose(), 1e-7));
  EXPECT_TRUE(isApprox(poses[1], Pose(expSo3({0, 0, M_PI / 2}), {1, 2, 3}), 1e-15));
}

TEST(Kitti, ChecksTheNumberOfColumnsAndTheRotation) {
  EXPECT_EQ(catchError([] { parseKitti("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1\n", "p.txt"); }),
            "p.txt:2: 11 columns: expected 12: a 3x4 matrix, row by row");
  EXPECT_EQ(catchError([] { parseKitti("1 0 0 0 0 1 0 0 0 0 1 inf\n", "p.txt"); }),
            "p.txt:1: `inf`: expected a finite number");
  EXPECT_EQ(catchError([] { parseKitti("1 0 0 0 0 1 0 0 0 0 -1 0\n", "p.txt"); }),
            "p.txt:1: a matrix that is not a rotation (tolerance 0.001)");
  EXPECT_EQ(catchError([] { parseKitti("2 0 0 0 0 1 0 0 0 0 1 0\n", "p.txt"); }),
            "p.txt:1: a matrix that is not a rotation (tolerance 0.001)");
  EXPECT_NE(catchError([] { parseKitti("1e200 0 0 0 0 1e200 0 0 0 0 1e200 0\n", "p.txt"); }), "");
}

TEST(Kitti, TimesRise) {
  EXPECT_EQ(parseTimes("0.000000e+00\n1.038170e-01\n\n0.3\n", "times.txt"),
            (std::vector<StampNs>{0, 103817000, 300000000}));
  EXPECT_EQ(catchError([] { parseTimes("0.1\n0.1\n", "times.txt"); }),
            "times.txt:2: 0.1 is not later than the previous time");
  EXPECT_EQ(catchError([] { parseTimes("0.1\n0.1 0.2\n", "times.txt"); }),
            "times.txt:2: `0.1 0.2`: expected seconds, one number a line");
}

TEST(Kitti, TimesHaveTheUnitThatTheirNumbersShow) {
  const std::vector<StampNs> expected = {1'403'636'579'700'000'000, 1'403'636'579'800'000'000};
  for (const char* text :
       {"1403636579.7\n1403636579.8\n", "1403636579700\n1403636579800\n", "1403636579700000\n1403636579800000\n",
        "1403636579700000000\n1403636579800000000\n", "1403636579,7\r\n1403636579,8\r\n",
        "time\n1403636579.7\n1403636579.8\n", "// s\n\"1403636579.7\"\n\"1403636579.8\"\n"})
    EXPECT_EQ(parseTimes(text, "times.txt"), expected) << text;
  EXPECT_EQ(parseTimes("0\n100000000\n200000000\n", "times.txt"), (std::vector<StampNs>{0, 100'000'000, 200'000'000}));
  EXPECT_EQ(parseTimes("0\n100000\n200000\n", "times.txt"), (std::vector<StampNs>{0, 100'000'000, 200'000'000}));
  EXPECT_EQ(parseTimes("0\n30\n60\n", "times.txt"),
            (std::vector<StampNs>{0, 30'000'000'000, 60'000'000'000}));  // a photograph every 30 s
}

TEST(Kitti, ReadsRealTruth) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  const std::string path = std::string(data == nullptr ? "" : data) + "/stereo/kitti06_000_050/poses.txt";
  if (data == nullptr || !std::filesystem::exists(path))
    GTEST_SKIP() << "URBAN_NAV_DATA names no folder with stereo/kitti06_000_050";
  EXPECT_EQ(readKitti(path).size(), 51U);
  EXPECT_EQ(readTimes(std::filesystem::path(path).replace_filename("times.txt").string()).size(), 51U);
}

TEST(Kitti, Fuzzed) {
  expectSurvives(testing::fuzzText({printKitti(somePoses()), "1 0 0 0 0 1 0 0 0 0 1 0\n"}, [](const std::string& text) {
    for (const Pose& pose : parseKitti(text, "p")) {
      if (!pose.isFinite()) throw std::runtime_error("a pose that is not finite");
    }
  }));
}

TEST(Kitti, TimesFuzzed) {
  expectSurvives(
      testing::fuzzText({"0.000000e+00\n1.038170e-01\n0.3\n"}, [](const std::string& text) { parseTimes(text, "t"); }));
}

}  // namespace
}  // namespace urban_nav_core
