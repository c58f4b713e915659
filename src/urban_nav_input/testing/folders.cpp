// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/testing/folders.hpp"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>

#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"

namespace urban_nav_input::testing {

namespace fs = std::filesystem;
using namespace urban_nav_core;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "urban_nav-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void writeFile(const std::string& path, const std::string& content) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << content;
}

void makeKittiFolder(const std::string& path, const KittiStyle& style) {
  urban_nav_core::testing::SequenceOptions options;
  options.camera.width = 240;
  options.camera.height = 180;
  options.camera.fx = options.camera.fy = 190.0;
  options.camera.cx = 119.5;
  options.camera.cy = 89.5;
  options.camera.baseline = 0.12;
  options.first_stamp = 0;
  urban_nav_core::testing::RenderedSequence sequence(urban_nav_core::testing::texturedRoom(),
                                                     urban_nav_core::testing::loop(2.5, 1.5, 1.1, 30.0), options);
  StereoCamera camera;
  camera.left = {190.0, 190.0, 119.5, 89.5, 240, 180};
  camera.baseline = 0.12;
  writeFile(path + "/calib.txt", printKittiCalibration(camera));
  std::string times;
  std::vector<Pose> poses;
  for (int i = 0; i < style.frames; ++i) {
    const auto& frame = sequence.frame(i);
    std::ostringstream name;
    name.fill('0');
    name.width(style.digits);
    name << i;
    for (const bool left : {true, false}) {
      const auto& image = left ? frame.left : frame.right;
      const fs::path folder = fs::path(path) / (left ? style.left : style.right);
      fs::create_directories(folder);
      cv::imwrite((folder / (name.str() + ".png")).string(),
                  cv::Mat(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data())));
    }
    times += printStamp(frame.stamp) + "\n";
    poses.push_back(sequence.T_world_camera(0).inverse() * sequence.T_world_camera(i));
  }
  if (style.times) writeFile(path + "/times.txt", times);
  if (style.truth) writeKitti(path + "/poses.txt", poses);
}

}  // namespace urban_nav_input::testing
