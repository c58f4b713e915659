// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/calibration.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "io/reader_check.hpp"

namespace urban_nav_core {
namespace {

const char* const kKitti =
    "P0: 7.070912000000e+02 0 6.018873000000e+02 0 0 7.070912000000e+02 1.831104000000e+02 0 0 0 1 0\n"
    "P1: 7.070912000000e+02 0 6.018873000000e+02 -3.798145000000e+02 0 "
    "7.070912000000e+02 1.831104000000e+02 0 0 0 1 0\n"
    "Tr: 1 2 3\n";
const char* const kInfo =
    "image_width: 512\nimage_height: 384\ncamera_name: left\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
    "  data: [390, 0, 255, 0, 391, 202, 0, 0, 1]\n"
    "distortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n"
    "  data: [-0.3, 0.1, 0.001, -0.002, 0]\n"
    "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
    "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [389.956, 0, 254.9, 0, 0, 389.956, 201.9, 0, 0, 0, 1, 0]\n";
const char* const kEuroc =
    "%YAML:1.0\n# General sensor definitions.\nsensor_type: camera\ncomment: VI-Sensor cam0 (MT9M034)\n\nT_BS:\n"
    "  cols: 4\n  rows: 4\n"
    "  data: [0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975,\n"
    "         0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768,\n"
    "        -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949,\n         0.0, 0.0, 0.0, 1.0]\n"
    "rate_hz: 20\nresolution: [752, 480]\ncamera_model: pinhole\n"
    "intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv\n"
    "distortion_model: radial-tangential\ndistortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, "
    "1.76187114e-05]\n";
const char* const kImu =
    "T_BS:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\nrate_hz: 200\n"
    "gyroscope_noise_density: 1.6968e-04\n"
    "gyroscope_random_walk: 1.9393e-05\naccelerometer_noise_density: 2.0000e-3\naccelerometer_random_walk: 3.0000e-3\n";

TEST(Calibration, KittiGivesTheStereoCamera) {
  const StereoCamera camera = parseKittiCalibration(kKitti, "calib.txt", 1226, 370);
  EXPECT_EQ(camera.left.fx, 707.0912);
  EXPECT_EQ(camera.left.cx, 601.8873);
  EXPECT_EQ(camera.left.cy, 183.1104);
  EXPECT_EQ(camera.left.width, 1226);
  EXPECT_NEAR(camera.baseline, 0.53715, 1e-5);
  EXPECT_TRUE(isApprox(parseKittiCalibration(printKittiCalibration(camera), "again", 1226, 370), camera, 1e-15));
}

TEST(Calibration, KittisCamerasNeedNotBeginAtTheOrigin) {
  std::string text = kKitti;  // both moved by the same 4.5
  text.replace(text.find("6.018873000000e+02 0"), 20, "6.018873000000e+02 4.5");
  text.replace(text.find("-3.798145000000e+02"), 19, "-3.753145000000e+02");
  EXPECT_NEAR(parseKittiCalibration(text, "c", 1226, 370).baseline, 0.53715, 1e-5);
}

TEST(Calibration, KittiHasAPairInColour) {
  std::string text = kKitti;
  text.replace(text.find("P0:"), 3, "P2:").replace(text.find("P1:"), 3, "P3:");
  EXPECT_NEAR(parseKittiCalibration(text, "calib.txt", 1226, 370, KittiPair::Colour).baseline, 0.53715, 1e-5);
  EXPECT_EQ(catchError([] { parseKittiCalibration(kKitti, "calib.txt", 1226, 370, KittiPair::Colour); }),
            "calib.txt: no line P2: expected `P2: ` and `P3: ` with twelve numbers each");
}

TEST(Calibration, KittiNamesWhatIsWrong) {
  EXPECT_EQ(catchError([] { parseKittiCalibration("P0: 1 2 3\n", "calib.txt", 10, 10); }),
            "calib.txt:1: P0 with 3 numbers: expected 12: a 3x4 matrix, row by row");
  EXPECT_EQ(catchError([] { parseKittiCalibration("Tr: 1 2 3\n", "calib.txt", 10, 10); }),
            "calib.txt: no line P0: expected `P0: ` and `P1: ` with twelve numbers each");
  std::string swapped = kKitti;
  swapped.replace(swapped.find("-3.798"), 6, "+3.798");
  EXPECT_NE(catchError([&] { parseKittiCalibration(swapped, "calib.txt", 10, 10); }), "");
  EXPECT_NE(catchError([&] { parseKittiCalibration(kKitti, "calib.txt", 0, 10); }), "");
}

TEST(Calibration, CameraInfoRoundTripIsExact) {
  const CameraInfo info = parseCameraInfo(kInfo, "left.yaml");
  EXPECT_EQ(info.width, 512);
  EXPECT_EQ(info.D, (std::vector<double>{-0.3, 0.1, 0.001, -0.002, 0.0}));
  EXPECT_EQ(info.K(1, 2), 202.0);
  EXPECT_EQ(info.P(0, 2), 254.9);
  const std::string text = printCameraInfo(info, "left");
  EXPECT_EQ(printCameraInfo(parseCameraInfo(text, "again"), "left"), text);
}

TEST(Calibration, CameraInfoNamesWhatIsWrong) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kInfo;
    text.replace(text.find(from), from.size(), to);
    return catchError([&text] { parseCameraInfo(text, "left.yaml"); });
  };
  EXPECT_EQ(with("image_width: 512", "image_width: 0"), "left.yaml:1: image_width = 0: expected 1...100000 (px)");
  EXPECT_EQ(with("image_width: 512", "image_wide: 512"), "left.yaml:1: no key `image_width`");
  EXPECT_EQ(with("[390, 0,", "[390,"), "left.yaml:7: data has 8 elements: expected 9 numbers in a list");
  EXPECT_NE(with("[390, 0,", "[-390, 0,"), "");
  EXPECT_EQ(with("data: [1, 0, 0, 0, 1", "data: [1, 0, 0, 0, 7"), "left.yaml: rectification_matrix is not a rotation");
  EXPECT_NE(with("plumb_bob", "fish"), "");
}

TEST(Calibration, EurocGivesCameraAndExtrinsics) {
  const EurocCamera camera = parseEurocCamera(kEuroc, "sensor.yaml");
  EXPECT_EQ(camera.rate_hz, 20.0);
  EXPECT_EQ(camera.info.width, 752);
  EXPECT_EQ(camera.info.K(0, 0), 458.654);
  EXPECT_EQ(camera.info.D[0], -0.28340811);
  EXPECT_TRUE(camera.T_body_camera.t().isApprox(Vector3d(-0.0216401454975, -0.064676986768, 0.00981073058949), 1e-15));
  EXPECT_NEAR(camera.T_body_camera.R()(1, 0), 0.999557249008, 1e-9);
  const EurocImu imu = parseEurocImu(kImu, "sensor.yaml");
  EXPECT_EQ(imu.gyroscope_noise, 1.6968e-04);
  EXPECT_TRUE(isApprox(imu.T_body_imu, Pose(), 0.0));
}

TEST(Calibration, EurocNamesWhatIsWrong) {
  std::string text = kEuroc;
  text.replace(text.find("0.999660727178"), 14, "0.099660727178");
  EXPECT_EQ(catchError([&] { parseEurocCamera(text, "sensor.yaml"); }), "sensor.yaml:6: T_BS is not a rotation");
  text = kImu;
  text.replace(text.find("1.6968e-04"), 10, "-1");
  EXPECT_EQ(catchError([&] { parseEurocImu(text, "sensor.yaml"); }),
            "sensor.yaml:6: gyroscope_noise_density = -1: expected 0 or more");
}

TEST(Calibration, ReadsRealFiles) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  const std::string stereo = std::string(data == nullptr ? "" : data) + "/stereo";
  if (data == nullptr || !std::filesystem::exists(stereo)) GTEST_SKIP() << "URBAN_NAV_DATA names no folder with stereo";
  EXPECT_NEAR(readKittiCalibration(stereo + "/kitti06_000_050/calib.txt", 1226, 370).baseline, 0.537, 1e-3);
  EXPECT_NEAR(readKittiCalibration(stereo + "/kitti_raw_0926_0005/calib_cam_to_cam.txt", 1242, 375).baseline, 0.537,
              1e-3);
  const EurocCamera left = readEurocCamera(stereo + "/euroc_still/mav0/cam0/sensor.yaml"),
                    right = readEurocCamera(stereo + "/euroc_still/mav0/cam1/sensor.yaml");
  EXPECT_NEAR((left.T_body_camera.inverse() * right.T_body_camera).t().norm(), 0.11, 2e-3);
}

TEST(Calibration, Fuzzed) {
  expectSurvives(testing::fuzzText({kKitti}, [](const std::string& text) {
    const StereoCamera camera = parseKittiCalibration(text, "c", 100, 100);
    if (!(camera.baseline > 0.0) || !std::isfinite(camera.left.cx + camera.left.fx))
      throw std::runtime_error("no camera");
  }));
  expectSurvives(testing::fuzzText({kInfo}, [](const std::string& text) {
    const CameraInfo info = parseCameraInfo(text, "c");
    if (!info.K.allFinite() || !info.P.allFinite() || !info.R.allFinite()) throw std::runtime_error("not finite");
  }));
  expectSurvives(testing::fuzzText({kEuroc}, [](const std::string& text) {
    if (!parseEurocCamera(text, "c").T_body_camera.isFinite()) throw std::runtime_error("not finite");
  }));
  expectSurvives(testing::fuzzText({kImu}, [](const std::string& text) {
    if (!parseEurocImu(text, "c").T_body_imu.isFinite()) throw std::runtime_error("not finite");
  }));
}

}  // namespace
}  // namespace urban_nav_core
