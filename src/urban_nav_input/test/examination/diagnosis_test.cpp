// SPDX-License-Identifier: BSD-3-Clause
// Faults injected into a sound session, each of which has to be named.
#include "urban_nav_input/examination/diagnosis.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>

#include <filesystem>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

namespace fs = std::filesystem;

using testing::readFile;
using testing::TemporaryFolder;
using testing::writeFile;

/// The kinds of an input's findings, and whether it can be used.
struct JudgedInput {
  std::multiset<std::string> kinds;
  std::string text;
  bool usable = true;
};

JudgedInput judge(const std::string& path, const SourceOptions& options = {}) {
  JudgedInput verdict;
  for (const InputSession& session : findSessions({path})) {
    const Diagnosis diagnosis = examine(session, options, [](std::int64_t, std::int64_t) {});
    for (const Finding& finding : diagnosis.findings) {
      verdict.kinds.insert(toString(finding.kind));
      verdict.text += std::string(toString(finding.kind)) + ": " + finding.text + " -> " + finding.remedy + "\n";
      EXPECT_FALSE(finding.remedy.empty()) << finding.text;
    }
    verdict.usable = verdict.usable && diagnosis.isUsable();
  }
  return verdict;
}

/// A rendered room as a KITTI folder, one for all tests, copied and damaged by each.
class FolderDoctor : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    testing::KittiStyle style;
    style.frames = 24;
    testing::makeKittiFolder(shared_->file("sound"), style);
  }
  static void TearDownTestSuite() { shared_.reset(); }

  void SetUp() override { fs::copy(shared_->file("sound"), path_, fs::copy_options::recursive); }

  /// Changes every image of a side.
  void changeImages(const std::string& side, const std::function<cv::Mat(const cv::Mat&)>& change) const {
    for (const auto& entry : fs::directory_iterator(path_ + "/" + side)) {
      const std::string file = entry.path().string();
      cv::imwrite(file, change(cv::imread(file, cv::IMREAD_UNCHANGED)));
    }
  }
  static cv::Mat warp(const cv::Mat& image, double angle_deg, double scale, double down) {
    const cv::Point2f middle(0.5F * cv::Point2f(cv::Point(image.size())));
    cv::Mat affine = cv::getRotationMatrix2D(middle, angle_deg, scale), warped;
    affine.at<double>(1, 2) += down;
    cv::warpAffine(image, warped, affine, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
    return warped;
  }
  void replaceCalibration(const std::function<void(double& f, double& cx, double& cy, double& shift)>& change) const {
    double f = 200.0, cx = 119.5, cy = 89.5, shift = -200.0 * 0.2;
    change(f, cx, cy, shift);
    const auto line = [&](const char* name, double t) {
      return std::string(name) + " " + std::to_string(f) + " 0 " + std::to_string(cx) + " " + std::to_string(t) +
             " 0 " + std::to_string(f) + " " + std::to_string(cy) + " 0 0 0 1 0\n";
    };
    writeFile(path_ + "/calib.txt", line("P0:", 0.0) + line("P1:", shift));
  }
  void writeTimes(const std::function<double(int)>& time) const {
    std::string times;
    for (int i = 0; i < 24; ++i) times += std::to_string(time(i)) + "\n";
    writeFile(path_ + "/times.txt", times);
  }

  static std::unique_ptr<TemporaryFolder> shared_;
  TemporaryFolder folder_;
  std::string path_ = folder_.file("input");
};
std::unique_ptr<TemporaryFolder> FolderDoctor::shared_;

TEST_F(FolderDoctor, FindsNothingInASoundSession) {
  const JudgedInput verdict = judge(path_);
  EXPECT_TRUE(verdict.usable);
  EXPECT_TRUE(verdict.kinds.empty()) << verdict.text;
}

TEST_F(FolderDoctor, NamesExchangedCameras) {
  fs::rename(path_ + "/image_0", path_ + "/other");
  fs::rename(path_ + "/image_1", path_ + "/image_0");
  fs::rename(path_ + "/other", path_ + "/image_1");
  const JudgedInput verdict = judge(path_);
  EXPECT_FALSE(verdict.usable);
  EXPECT_NE(verdict.text.find("exchanged"), std::string::npos) << verdict.text;
}

TEST_F(FolderDoctor, NamesImagesOfAnotherScene) {
  changeImages("image_1", [](const cv::Mat& image) {
    cv::Mat turned;
    cv::rotate(image, turned, cv::ROTATE_180);
    return turned;
  });
  EXPECT_EQ(judge(path_).kinds.count("pairs"), 1U) << judge(path_).text;
}

TEST_F(FolderDoctor, NamesMissingAndDamagedImages) {
  fs::remove(path_ + "/image_1/000005.png");
  writeFile(path_ + "/image_0/000009.png", "no image");
  const JudgedInput verdict = judge(path_);
  EXPECT_TRUE(verdict.usable);
  EXPECT_GE(verdict.kinds.count("pairs"), 2U) << verdict.text;
}

TEST_F(FolderDoctor, NamesRowsThatDiffer) {
  changeImages("image_1", [](const cv::Mat& image) { return warp(image, 0.0, 1.0, 2.0); });
  EXPECT_EQ(judge(path_).kinds.count("rectification"), 1U) << judge(path_).text;
}

TEST_F(FolderDoctor, NamesACameraThatIsRotated) {
  changeImages("image_1", [](const cv::Mat& image) { return warp(image, 1.5, 1.0, 0.0); });
  const JudgedInput verdict = judge(path_);
  EXPECT_EQ(verdict.kinds.count("rectification"), 1U) << verdict.text;
  EXPECT_NE(verdict.text.find("optical axis"), std::string::npos) << verdict.text;
}

TEST_F(FolderDoctor, NamesFocalLengthsThatDiffer) {
  changeImages("image_1", [](const cv::Mat& image) { return warp(image, 0.0, 1.04, 0.0); });
  const JudgedInput verdict = judge(path_);
  EXPECT_EQ(verdict.kinds.count("rectification"), 1U) << verdict.text;
  EXPECT_NE(verdict.text.find("focal lengths"), std::string::npos) << verdict.text;
}

TEST_F(FolderDoctor, NamesBlackSaturatedAndUnequalImages) {
  changeImages("image_0", [](const cv::Mat& image) { return cv::Mat(image / 32); });
  const JudgedInput dark = judge(path_);
  EXPECT_GE(dark.kinds.count("depth"), 1U) << dark.text;
  changeImages("image_0", [](const cv::Mat& image) { return cv::Mat(image * 255); });
  const JudgedInput bright = judge(path_);
  EXPECT_GE(bright.kinds.count("depth"), 1U) << bright.text;
}

TEST_F(FolderDoctor, NamesABaselineInMillimetres) {
  replaceCalibration([](double&, double&, double&, double& shift) { shift *= 1000.0; });
  const JudgedInput verdict = judge(path_);
  EXPECT_EQ(verdict.kinds.count("calibration"), 1U) << verdict.text;
  EXPECT_NE(verdict.text.find("millimetres"), std::string::npos) << verdict.text;
}

TEST_F(FolderDoctor, NamesACalibrationOfLargerImages) {
  replaceCalibration([](double& f, double& cx, double& cy, double& shift) { f *= 2, cx *= 2, cy *= 2, shift *= 2; });
  const JudgedInput verdict = judge(path_);
  EXPECT_GE(verdict.kinds.count("calibration"), 1U) << verdict.text;
}

TEST_F(FolderDoctor, NamesAnImpossibleFieldOfView) {
  replaceCalibration([](double& f, double&, double&, double& shift) { f *= 20, shift *= 20; });
  EXPECT_EQ(judge(path_).kinds.count("calibration"), 1U) << judge(path_).text;
}

TEST_F(FolderDoctor, NamesMissingCalibration) {
  fs::remove(path_ + "/calib.txt");
  const JudgedInput verdict = judge(path_);
  EXPECT_FALSE(verdict.usable);
  EXPECT_EQ(verdict.kinds.count("calibration"), 1U) << verdict.text;
}

TEST_F(FolderDoctor, ReportsStampsThatDoNotChange) {
  writeTimes([](int i) { return 0.05 * (i == 12 ? 11 : i); });
  EXPECT_GE(judge(path_).kinds.count("stamps"), 1U) << judge(path_).text;
}

TEST_F(FolderDoctor, NamesStampsOfArrival) {
  writeTimes([](int i) { return 0.05 * i + (i % 3 == 0 ? 0.03 : 0.0); });
  EXPECT_EQ(judge(path_).kinds.count("stamps"), 1U) << judge(path_).text;
}

TEST_F(FolderDoctor, NamesGapsAndLowRates) {
  writeTimes([](int i) { return 0.05 * i + (i > 10 ? 3.0 : 0.0); });
  EXPECT_EQ(judge(path_).kinds.count("rates"), 1U) << judge(path_).text;
  writeTimes([](int i) { return 1.0 * i; });
  EXPECT_EQ(judge(path_).kinds.count("rates"), 1U) << judge(path_).text;
}

/// A bag of plain grey images with an IMU and a laser.
struct BagRecipe {
  double right_late = 0.0;  ///< s
  bool stamped = true, right_exists = true;
  double imu_rate = 100.0;  ///< Hz; 0: none
  bool laser_gap = false, calibrated = true;
  int frames = 40;
  std::function<double(int)> time = [](int i) { return 1.5e9 + 0.05 * i; };
};

void writeDoctorBag(const std::string& path, const BagRecipe& recipe) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  const auto add = [&](const std::string& topic, auto message, double receipt, double stamp, const char* frame) {
    if (recipe.stamped) message.header.stamp = ros::Time(stamp);
    message.header.frame_id = frame;
    bag.write(topic, ros::Time(receipt), message);
  };
  sensor_msgs::Image image;
  image.encoding = "mono8";
  image.width = image.step = 32;
  image.height = 24;
  image.data.assign(image.step * image.height, 100);
  sensor_msgs::CameraInfo info;
  info.width = 32;
  info.height = 24;
  for (int i = 0; i < recipe.frames; ++i) {
    const double left = recipe.time(i), right = left + recipe.right_late, receipt = 1.5e9 + 0.05 * i + 0.01;
    for (const bool is_right : {false, true}) {
      if (is_right && !recipe.right_exists) continue;
      const std::string side = is_right ? "/stereo/right/" : "/stereo/left/";
      info.P = {30, 0, 15.5, is_right ? -6.0 : 0.0, 0, 30, 11.5, 0, 0, 0, 1, 0};
      add(side + "image_raw", image, receipt, is_right ? right : left, "camera");
      if (recipe.calibrated) add(side + "camera_info", info, receipt, is_right ? right : left, "camera");
    }
    if (!recipe.laser_gap || i < 10 || i > 38)
      for (int k = 0; k < 2; ++k) add("/laser_left/scan", sensor_msgs::LaserScan(), receipt + 0.02 * k, left, "laser");
  }
  for (int i = 0; i < 2 * recipe.imu_rate; ++i) {
    sensor_msgs::Imu imu;
    imu.linear_acceleration.z = 9.8 + 0.01 * (i % 7);
    add("/imu/data", imu, 1.5e9 + i / recipe.imu_rate, 1.5e9 + i / recipe.imu_rate, "imu");
  }
}

JudgedInput judgeBag(const std::function<void(BagRecipe&)>& change) {
  const TemporaryFolder folder;
  BagRecipe recipe;
  change(recipe);
  writeDoctorBag(folder.file("a.bag"), recipe);
  return judge(folder.file("a.bag"));
}

TEST(BagDoctor, NamesTransformsThatAreMissing) {
  const JudgedInput verdict = judgeBag([](BagRecipe&) {});
  EXPECT_TRUE(verdict.usable);
  EXPECT_EQ(verdict.kinds, (std::multiset<std::string>{"tf", "tf", "tf"})) << verdict.text;
  EXPECT_NE(verdict.text.find("base_link camera"), std::string::npos) << verdict.text;
  EXPECT_NE(verdict.text.find("base_link laser"), std::string::npos) << verdict.text;
  EXPECT_NE(verdict.text.find("base_link imu"), std::string::npos) << verdict.text;
}

TEST(BagDoctor, NamesImagesWithoutStamps) {
  const auto verdict = judgeBag([](BagRecipe& recipe) { recipe.stamped = false; });
  EXPECT_EQ(verdict.kinds.count("stamps"), 2U) << verdict.text;  // images and IMU
  EXPECT_NE(verdict.text.find("/imu/data"), std::string::npos) << verdict.text;
}

TEST(BagDoctor, NamesAClockThatWasSet) {
  const JudgedInput verdict =
      judgeBag([](BagRecipe& recipe) { recipe.time = [](int i) { return 1.5e9 + 0.05 * i - (i > 20 ? 50.0 : 0.0); }; });
  EXPECT_GE(verdict.kinds.count("stamps"), 1U) << verdict.text;
}

TEST(BagDoctor, NamesTheDelayOfOneCamera) {
  const JudgedInput verdict = judgeBag([](BagRecipe& recipe) { recipe.right_late = 0.012; });
  EXPECT_FALSE(verdict.usable);
  EXPECT_NE(verdict.text.find("input.right_delay=12"), std::string::npos) << verdict.text;
}

TEST(BagDoctor, NamesACameraThatIsMissing) {
  const JudgedInput verdict = judgeBag([](BagRecipe& recipe) { recipe.right_exists = false; });
  EXPECT_FALSE(verdict.usable);
  EXPECT_EQ(verdict.kinds.count("pairs"), 1U) << verdict.text;
}

TEST(BagDoctor, NamesTheCalibrationOfBothCameras) {
  const JudgedInput verdict = judgeBag([](BagRecipe& recipe) { recipe.calibrated = false; });
  EXPECT_FALSE(verdict.usable);
  EXPECT_EQ(verdict.kinds.count("calibration"), 1U) << verdict.text;
  EXPECT_NE(verdict.text.find("the left and the right images"), std::string::npos) << verdict.text;
  EXPECT_NE(verdict.text.find("--topic left_info:=NAME --topic right_info:=NAME"), std::string::npos) << verdict.text;
}

TEST(BagDoctor, SurvivesAnyDamage) {
  const TemporaryFolder folder;
  BagRecipe recipe;
  recipe.frames = 4;
  recipe.imu_rate = 5.0;
  writeDoctorBag(folder.file("a.bag"), recipe);
  const urban_nav_core::testing::FuzzResult result =
      urban_nav_core::testing::fuzzFile({readFile(folder.file("a.bag"))}, "damaged.bag", [](const std::string& path) {
        std::vector<Diagnosis> unreadable;
        for (const InputSession& session : findSessions(separateUnreadable({path}, unreadable)))
          for (const Finding& finding : examine(session, {}, [](std::int64_t, std::int64_t) {}).findings)
            EXPECT_FALSE(finding.remedy.empty()) << finding.text;
        for (const Diagnosis& diagnosis : unreadable) EXPECT_FALSE(diagnosis.findings.empty());
      });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 1);
}

TEST(BagDoctor, NamesABagThatWasCutOff) {
  const TemporaryFolder folder;
  writeDoctorBag(folder.file("whole.bag"), BagRecipe());
  const std::string bytes = readFile(folder.file("whole.bag"));
  writeFile(folder.file("cut.bag"), bytes.substr(0, bytes.size() / 2));
  std::vector<Diagnosis> unreadable;
  EXPECT_EQ(separateUnreadable({folder.file("cut.bag")}, unreadable), std::vector<std::string>{folder.file("cut.bag")});
  std::string text;
  for (const InputSession& session : findSessions({folder.file("cut.bag")}))
    for (const Finding& finding : examine(session, {}, [](std::int64_t, std::int64_t) {}).findings)
      text += finding.text + "\n";
  EXPECT_NE(text.find("cut off"), std::string::npos) << text;
  writeFile(folder.file("short.bag"), bytes.substr(0, 1000));
  EXPECT_EQ(separateUnreadable({folder.file("whole.bag"), folder.file("short.bag")}, unreadable),
            std::vector<std::string>{folder.file("whole.bag")});
  ASSERT_EQ(unreadable.size(), 1U);
  EXPECT_FALSE(unreadable.front().isUsable());
  ASSERT_EQ(unreadable.front().findings.size(), 1U);
}

TEST(BagDoctor, NamesSlowDevicesAndGapsOfDevices) {
  EXPECT_EQ(judgeBag([](BagRecipe& recipe) { recipe.imu_rate = 20.0; }).kinds.count("rates"), 1U);
  EXPECT_EQ(judgeBag([](BagRecipe& recipe) { recipe.laser_gap = true; }).kinds.count("rates"), 1U);
}

}  // namespace
}  // namespace urban_nav_input
