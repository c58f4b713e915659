// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/stereo_calibration.hpp"

#include <cmath>
#include <stdexcept>

#include "io/reader_check.hpp"
#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/io/calibration.hpp"

namespace urban_nav_core {
namespace {

const std::string kCamchain =
    "cam0:\n  camera_model: pinhole\n  distortion_coeffs: [0.0, 0.0, 0.0, 0.0]\n  distortion_model: radtan\n"
    "  intrinsics: [220.0, 221.0, 103.5, 63.5]\n  resolution: [208, 128]\n"
    "cam1:\n  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, -0.2]\n  - [0.0, 1.0, 0.0, 0.0]\n  - [0.0, 0.0, 1.0, 0.0]\n"
    "  - [0.0, 0.0, 0.0, 1.0]\n  camera_model: pinhole\n  distortion_coeffs: [0.0, 0.0, 0.0, 0.0]\n"
    "  distortion_model: radtan\n  intrinsics: [220.0, 221.0, 103.5, 63.5]\n  resolution: [208, 128]\n";

std::string ostSection(const std::string& offset) {
  return "# oST version 5.0 parameters\n\n[image]\n\nwidth\n208\n\nheight\n128\n\n[narrow_stereo/left]\n\n"
         "camera matrix\n220 0 103.5\n0 221 63.5\n0 0 1\n\ndistortion\n0.1 0 0 0 0\n\n"
         "rectification\n1 0 0\n0 1 0\n0 0 1\n\nprojection\n220 0 103.5 " +
         offset + "\n0 221 63.5 0\n0 0 1 0\n";
}

std::string euroc(const std::string& x) {
  return "%YAML:1.0\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, " + x +
         ", 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\nresolution: [208, 128]\nintrinsics: [220, 221, 103.5, 63.5]\n"
         "distortion_model: radial-tangential\ndistortion_coefficients: [0, 0, 0, 0]\n";
}

void expectPair(const CameraPair& pair) {
  const StereoCamera camera = stereoCamera(pair.first, pair.second, "pair");
  EXPECT_NEAR(camera.baseline, 0.2, 1e-12);
  EXPECT_EQ(camera.left.fx, 220.0);
  EXPECT_EQ(camera.left.fy, 221.0);
  EXPECT_EQ(camera.left.cx, 103.5);
  EXPECT_EQ(camera.left.width, 208);
}

TEST(StereoCalibration, EveryFormatGivesThePair) {
  expectPair(parseStereoCalibration({kCamchain}, {"camchain.yaml"}));
  expectPair(parseStereoCalibration({ostSection("0") + ostSection("-44")}, {"ost.txt"}));
  expectPair(parseStereoCalibration({ostSection("0"), ostSection("-44")}, {"left.txt", "right.txt"}));
  expectPair(parseStereoCalibration({euroc("0"), euroc("0.2")}, {"cam0.yaml", "cam1.yaml"}));
  const CameraPair pair = parseCamchain(kCamchain, "c");
  expectPair(parseStereoCalibration({printCameraInfo(pair.first, "left"), printCameraInfo(pair.second, "right")},
                                    {"left.yaml", "right.yaml"}));
  EXPECT_FALSE(needsRectification(pair.first));
  EXPECT_TRUE(needsRectification(parseOst(ostSection("0"), "ost.txt").front()));
}

TEST(StereoCalibration, APairThatIsTurnedIsRectified) {
  const CameraInfo raw = parseCamchain(kCamchain, "c").first;
  const Pose T_right_left(expSo3({0.01, 0.02, -0.03}), {-0.2, 0.01, 0.005});
  const CameraPair pair = rectifiedPair(raw, raw, T_right_left, "c");
  const Pose T_left_right = T_right_left.inverse();
  const Vector3d seen_by_left = pair.first.R * T_left_right.t();
  EXPECT_NEAR(seen_by_left.y(), 0.0, 1e-12);
  EXPECT_NEAR(seen_by_left.z(), 0.0, 1e-12);
  EXPECT_TRUE((pair.second.R * T_right_left.R()).isApprox(pair.first.R, 1e-12));
  EXPECT_NEAR(stereoCamera(pair.first, pair.second, "c").baseline, T_right_left.t().norm(), 1e-12);
}

TEST(StereoCalibration, NamesWhatIsWrong) {
  const auto refusal = [](const std::vector<std::string>& texts) {
    return catchError([&] {
      parseStereoCalibration(texts,
                             texts.size() == 1 ? std::vector<std::string>{"a"} : std::vector<std::string>{"a", "b"});
    });
  };
  EXPECT_NE(refusal({ostSection("0")}).find("1 camera"), std::string::npos);
  EXPECT_NE(refusal({euroc("0")}).find("one camera"), std::string::npos);
  EXPECT_NE(refusal({euroc("0"), ostSection("0")}).find("not of the same kind"), std::string::npos);
  EXPECT_NE(refusal({euroc("0.2"), euroc("0")}).find("left and right swapped"), std::string::npos);
  std::string omni = kCamchain;
  omni.replace(omni.find("pinhole"), 7, "omni");
  EXPECT_NE(refusal({omni}).find("camera_model = omni"), std::string::npos);
}

TEST(StereoCalibration, SurvivesDamage) {
  expectSurvives(testing::fuzzText({kCamchain, ostSection("0") + ostSection("-44")}, [](const std::string& text) {
    const CameraPair pair = parseStereoCalibration({text}, {"c"});
    if (!pair.first.P.allFinite() || !pair.second.P.allFinite()) throw std::runtime_error("not finite");
  }));
  expectSurvives(testing::fuzzText({euroc("0.2"), ostSection("-44")}, [](const std::string& text) {
    const bool is_euroc = calibrationKind(text) == CalibrationKind::Euroc;
    parseStereoCalibration({is_euroc ? euroc("0") : ostSection("0"), text}, {"c", "d"});
  }));
}

}  // namespace
}  // namespace urban_nav_core
