// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/parameters.hpp"
#include "commands/stages.hpp"
#include "convert/convert.hpp"
#include "map/map_pipeline.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/bags.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

namespace fs = std::filesystem;
using urban_nav_core::DataError;
using urban_nav_core::UserError;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_input::testing::writeFile;

const std::vector<std::string> kSame = {"trajectory.tum",          "trajectory.kitti", "covariance.csv",
                                        "relative_covariance.csv", "graph.g2o",        "landmarks.ply"};

void map(const std::vector<std::string>& inputs, const std::string& out, int threads = 1,
         const std::function<void(MapOptions&)>& change = {}) {
  const Arguments none({}, addStageTables);
  MapOptions request{inputs, out, {"vo"}, "", "", "", {}, loadParameters(none), threads};
  if (change) change(request);
  Console console;
  runMap(request, makeStages(), console);
}

void expectSame(const std::string& a, const std::string& b) {
  for (const std::string& name : kSame) EXPECT_EQ(readFile(a + "/" + name), readFile(b + "/" + name)) << name;
}

/// A folder that several tests map: rendered once.
class Map : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    urban_nav_input::testing::makeKittiFolder(in());
    map({in()}, out());
  }
  static void TearDownTestSuite() { shared_.reset(); }
  static std::string in() { return shared_->file("in"); }
  static std::string out() { return shared_->file("out"); }

 private:
  static std::unique_ptr<TemporaryFolder> shared_;
};
std::unique_ptr<TemporaryFolder> Map::shared_;

TEST_F(Map, WritesAPosePerFrameNearTheTruth) {
  const urban_nav_core::Trajectory trajectory = urban_nav_core::readTum(out() + "/trajectory.tum");
  const std::vector<urban_nav_core::Pose> estimate = urban_nav_core::readKitti(out() + "/trajectory.kitti"),
                                          truth = urban_nav_core::readKitti(in() + "/poses.txt");
  ASSERT_EQ(trajectory.size(), 16U);
  ASSERT_EQ(estimate.size(), truth.size());
  EXPECT_EQ(trajectory[3].stamp, 150'000'000);
  EXPECT_TRUE(isApprox(trajectory.front().pose, urban_nav_core::Pose(), 1e-9)) << "odom is the first base_link";
  EXPECT_LT(distanceBetween(estimate.back(), truth.back()), 0.05);
  EXPECT_GT(distanceBetween(truth.front(), truth.back()), 0.2) << "else the test says nothing";
  for (const char* name : {"stats.csv", "summary.json", "report.html"})
    EXPECT_FALSE(readFile(out() + "/" + name).empty()) << name;
}

TEST_F(Map, HasThePromisedContent) {
  const std::string summary = readFile(out() + "/summary.json");
  for (const char* key :
       {"wall_s",        "cpu_s",     "peak_rss_bytes", "realtime_factor", "distance_m",        "frames",
        "swf_vo",        "ms_median", "ms_p99",         "features_mean",   "track_length_mean", "reprojection_px_mean",
        "status_counts", "warnings",  "ate_m",          "ate_se3_m",       "ate_sim3_m",        "rpe_percent",
        "rpe_deg_per_m", "nees_mean", "frames_truth",   "frames_estimate"}) {
    EXPECT_NE(summary.find("\"" + std::string(key) + "\":"), std::string::npos) << key;
  }
  const std::string report = readFile(out() + "/report.html");
  EXPECT_EQ(report.find("http-equiv=\"refresh\""), std::string::npos) << "a finished report stands still";
  for (const char* word : {"src=\"http", "href=\"http", "url(http", "@import"})
    EXPECT_EQ(report.find(word), std::string::npos) << word;
}

TEST_F(Map, RunsTheGraphWithoutGivenClosures) {
  const TemporaryFolder folder;
  const auto all = [](MapOptions& request) { request.stages.clear(); };
  map({in()}, folder.file("out"), 1, all);
  const std::string summary = readFile(folder.file("out/summary.json"));
  for (const char* key :
       {"pose_graph", "poses", "edges", "edges_rejected", "cost_before", "cost_after", "ms_batch", "sessions_joined"})
    EXPECT_NE(summary.find("\"" + std::string(key) + "\":"), std::string::npos) << key;
  for (const char* name : {"covariance.csv", "relative_covariance.csv", "landmarks.ply"})
    EXPECT_EQ(readFile(folder.file("out/") + name), readFile(out() + "/" + name)) << name;
  EXPECT_TRUE(isApprox(urban_nav_core::readTum(folder.file("out/trajectory.tum")),
                       urban_nav_core::readTum(out() + "/trajectory.tum"), 1e-9));

  urban_nav_input::testing::KittiStyle one;
  one.frames = 1;
  urban_nav_input::testing::makeKittiFolder(folder.file("one"), one);
  map({folder.file("one")}, folder.file("short"), 1, all);
  EXPECT_EQ(urban_nav_core::readTum(folder.file("short/trajectory.tum")).size(), 1U);
}

TEST_F(Map, TheReportOfARecordingThatGoesOnRefreshesItself) {
  const TemporaryFolder folder;
  const auto refreshes = [&](double so_far) {
    map({in()}, folder.file("out"), 1, [&](MapOptions& request) { request.so_far = so_far; });
    const std::string report = readFile(folder.file("out/report.html"));
    EXPECT_NE(report.find("href=\"#truth\""), std::string::npos) << "what there is, is compared with the truth";
    EXPECT_EQ(report.find("in progress, 25 %") != std::string::npos, so_far < 1.0);
    return report.find("http-equiv=\"refresh\"") != std::string::npos;
  };
  EXPECT_TRUE(refreshes(0.25));
  expectSame(out(), folder.file("out"));
  EXPECT_FALSE(refreshes(1.0));
}

TEST_F(Map, GivesEqualBytesWithTwoThreads) {
  const TemporaryFolder folder;
  map({in()}, folder.file("two"), 2);
  expectSame(out(), folder.file("two"));
}

TEST_F(Map, KeepsTheTruthFromTheEstimate) {
  const TemporaryFolder folder;
  fs::copy(in(), folder.file("in"), fs::copy_options::recursive);
  fs::remove(folder.file("in/poses.txt"));
  map({folder.file("in")}, folder.file("without"));
  expectSame(out(), folder.file("without"));
  EXPECT_EQ(readFile(folder.file("without/summary.json")).find("ate_m"), std::string::npos);
  for (const char* scrambled : {"no poses at all\n", "1 0 0 7 0 1 0 8 0 0 1 9\n"}) {
    writeFile(folder.file("in/poses.txt"), scrambled);
    map({folder.file("in")}, folder.file("scrambled"));
    expectSame(out(), folder.file("scrambled"));
  }
}

TEST_F(Map, GoesOnOverADamagedImageAndNamesIt) {
  const TemporaryFolder folder;
  fs::copy(in(), folder.file("in"), fs::copy_options::recursive);
  writeFile(folder.file("in/image_0/000008.png"), readFile(in() + "/image_0/000008.png").substr(0, 500));
  map({folder.file("in")}, folder.file("out"));
  EXPECT_EQ(urban_nav_core::readKitti(folder.file("out/trajectory.kitti")).size(), 16U);
  EXPECT_NE(readFile(folder.file("out/summary.json")).find("000008.png"), std::string::npos);
}

TEST_F(Map, ReportsExchangedCameras) {
  const TemporaryFolder folder;
  fs::copy(in(), folder.file("in"), fs::copy_options::recursive);
  fs::rename(folder.file("in/image_0"), folder.file("in/left"));
  fs::rename(folder.file("in/image_1"), folder.file("in/image_0"));
  fs::rename(folder.file("in/left"), folder.file("in/image_1"));
  ::testing::internal::CaptureStderr();
  map({folder.file("in")}, folder.file("out"));
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("16 DEGRADED of 16 frames; most often: left and right are exchanged"), std::string::npos) << said;
  const std::string summary = readFile(folder.file("out/summary.json"));
  EXPECT_NE(summary.find("\"swapped\": 16"), std::string::npos);
  EXPECT_EQ(summary.find("\"none\":", summary.find("\"reason_counts\"")), std::string::npos);
}

TEST_F(Map, RefusesWhatCannotBeMapped) {
  const TemporaryFolder folder;
  const auto with_stage = [](const char* stage) { return [stage](MapOptions& request) { request.stages = {stage}; }; };
  EXPECT_THROW(map({in()}, folder.file("out"), 1, with_stage("vision")), UserError);
  EXPECT_THROW(map({in()}, folder.file("out"), 1, [](MapOptions& request) { request.truth = "/nowhere.tum"; }),
               UserError);
  fs::copy(in(), folder.file("in"), fs::copy_options::recursive);
  for (const char* side : {"image_0", "image_1"}) {
    for (const auto& entry : fs::directory_iterator(folder.file(std::string("in/") + side)))
      writeFile(entry.path().string(), "damaged");
  }
  EXPECT_THROW(map({folder.file("in")}, folder.file("out")), DataError);
}

TEST_F(Map, WarnsOfImagesWhoseRowsDiffer) {
  const TemporaryFolder folder;
  urban_nav_input::testing::KittiStyle style;
  style.frames = 40;
  urban_nav_input::testing::makeKittiFolder(folder.file("in"), style);
  map({folder.file("in")}, folder.file("sound"));
  EXPECT_EQ(readFile(folder.file("sound/summary.json")).find("px lower in right images"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(folder.file("in") + "/image_1")) {
    const cv::Mat image = cv::imread(entry.path().string(), cv::IMREAD_UNCHANGED);
    cv::Mat lower;
    cv::copyMakeBorder(image.rowRange(0, image.rows - 2), lower, 2, 0, 0, 0, cv::BORDER_REFLECT);
    cv::imwrite(entry.path().string(), lower);
  }
  map({folder.file("in")}, folder.file("lower"));
  EXPECT_NE(readFile(folder.file("lower/summary.json")).find("px lower in right images"), std::string::npos);
}

TEST_F(Map, TheMapOfAnotherRecordingIsReplacedOnRequestAlone) {
  const TemporaryFolder folder;
  fs::copy(in(), folder.file("other"), fs::copy_options::recursive);
  for (const char* image : {"image_0/000015.png", "image_1/000015.png"}) fs::remove(folder.file("other") + "/" + image);
  const std::string out_folder = folder.file("out");
  map({in()}, out_folder);
  const std::string before = readFile(out_folder + "/trajectory.tum");
  EXPECT_THROW(map({folder.file("other")}, out_folder), UserError);
  EXPECT_EQ(readFile(out_folder + "/trajectory.tum"), before);
  map({in()}, out_folder);  // the same recording again
  EXPECT_EQ(readFile(out_folder + "/trajectory.tum"), before);
  map({folder.file("other")}, out_folder, 1, [](MapOptions& request) { request.overwrite = true; });
  EXPECT_NE(readFile(out_folder + "/trajectory.tum"), before);
}

TEST_F(Map, ReportsWhyNoFrameWasUsable) {
  const TemporaryFolder folder;
  fs::copy(in(), folder.file("in"), fs::copy_options::recursive);
  for (const char* camera : {"image_0", "image_1"})
    for (const auto& entry : fs::directory_iterator(folder.file("in") + "/" + camera))
      cv::imwrite(entry.path().string(), cv::Mat::zeros(180, 240, CV_8U));
  try {
    map({folder.file("in")}, folder.file("out"));
    FAIL() << "there was nothing to see";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("dark"), std::string::npos) << error.what();
  }
}

TEST_F(Map, ReadsItsOwnBagsLikeTheFolder) {
  const TemporaryFolder folder;
  Console console;
  const Converted converted = convertStereoFolder(in(), folder.file("in.bag"), {}, console);
  EXPECT_EQ(converted.counts.at("/stereo/left/image_raw"), 16);
  EXPECT_EQ(converted.counts.at("/stereo/right/camera_info"), 16);
  EXPECT_EQ(converted.counts.at("/ground_truth/pose"), 16);
  EXPECT_EQ(converted.counts.at("/tf_static"), 1);
  map({folder.file("in.bag")}, folder.file("out"));
  EXPECT_EQ(readFile(out() + "/trajectory.kitti"), readFile(folder.file("out/trajectory.kitti")))
      << "same images, same camera, same bytes";
  EXPECT_NE(readFile(folder.file("out/summary.json")).find("/ground_truth/pose"), std::string::npos);

  urban_nav_input::testing::rewriteBag(folder.file("in.bag"), folder.file("shuffled.bag"),
                                       urban_nav_input::testing::Rewrite::Shuffle);
  map({folder.file("shuffled.bag")}, folder.file("shuffled"), 2);
  expectSame(folder.file("out"), folder.file("shuffled"));

  urban_nav_input::testing::rewriteBag(folder.file("in.bag"), folder.file("blind.bag"),
                                       urban_nav_input::testing::Rewrite::WithoutTruth);
  map({folder.file("blind.bag")}, folder.file("blind"));
  expectSame(folder.file("out"), folder.file("blind"));

  urban_nav_input::testing::rewriteBag(folder.file("in.bag"), folder.file("other.bag"),
                                       urban_nav_input::testing::Rewrite::CompressedColourUnderOtherNames);
  map({folder.file("other.bag")}, folder.file("other"), 1,
      [&](MapOptions& request) { request.source.calibration = in() + "/calib.txt"; });
  EXPECT_EQ(readFile(out() + "/trajectory.kitti"), readFile(folder.file("other/trajectory.kitti")))
      << "PNG in colour holds the same grey";
}

TEST_F(Map, JoinsTheBagsOfASplitRecordingAndKeepsSessionsApart) {
  const TemporaryFolder folder;
  Console console;
  convertStereoFolder(in(), folder.file("a.bag"), {}, console);
  urban_nav_input::testing::delayBag(folder.file("a.bag"), folder.file("b.bag"), 2.0);
  urban_nav_input::testing::delayBag(folder.file("a.bag"), folder.file("c.bag"), 100.0);
  map({folder.file("c.bag"), folder.file("a.bag"), folder.file("b.bag")}, folder.file("out"));
  EXPECT_EQ(urban_nav_core::readTum(folder.file("out/trajectory.tum")).size(), 32U);
  EXPECT_EQ(urban_nav_core::readTum(folder.file("out/trajectory_2.tum")).size(), 16U);
  EXPECT_FALSE(fs::exists(folder.file("out/trajectory_3.tum")));
  map({folder.file("a.bag")}, folder.file("out"), 1, [](MapOptions& request) { request.overwrite = true; });
  EXPECT_FALSE(fs::exists(folder.file("out/trajectory_2.tum"))) << "of the run before";
}

TEST_F(Map, LeavesNoHalfBag) {
  const TemporaryFolder folder;
  fs::copy(in(), folder.file("in"), fs::copy_options::recursive);
  writeFile(folder.file("in/image_1/000005.png"), "damaged");
  Console console;
  try {
    convertStereoFolder(folder.file("in"), folder.file("in.bag"), {}, console);
    FAIL() << "a damaged image must end a conversion";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("image_1/000005.png"), std::string::npos) << error.what();
  }
  for (const auto& entry : fs::directory_iterator(folder.file("")))
    EXPECT_EQ(entry.path().filename(), "in") << entry.path();
}

}  // namespace
}  // namespace urban_nav
