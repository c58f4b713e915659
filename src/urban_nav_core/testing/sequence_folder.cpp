// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/sequence_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::testing {
namespace {

namespace fs = std::filesystem;

void writeImage(const fs::path& folder, int index, const GreyImage& image) {
  if (image.pixels.empty()) return;  // a missing image is a missing file
  std::string name = std::to_string(index);
  name.insert(0, 6 - std::min<std::size_t>(6, name.size()), '0');
  PartialFile file((folder / (name + ".png")).string());
  const cv::Mat pixels(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data()));
  if (!cv::imwrite(file.path(), pixels)) throw std::runtime_error("cannot write " + file.path());
  file.commit();
}

std::string calibration(const RenderCamera& camera) {
  const auto line = [&camera](const char* name, double shift) {
    const double P[12] = {camera.fx, 0, camera.cx, shift, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
    std::string text = name;
    for (const double value : P) text += " " + printNumber(value);
    return text + "\n";
  };
  return line("P0:", 0.0) + line("P1:", -camera.fx * camera.baseline);
}

}  // namespace

int writeSequenceFolder(RenderedSequence& sequence, int frames, FaultFilter faults, const std::string& folder,
                        const std::function<void(int)>& progress) {
  const fs::path root = folder;
  if (fs::exists(root) && !fs::is_empty(root)) throw UserError(folder, "is not empty", "a new or empty folder");
  fs::create_directories(root / "image_0");
  fs::create_directories(root / "image_1");
  writeAtomically((root / "calib.txt").string(), calibration(sequence.options().camera));
  std::string times;
  std::vector<Pose> poses;
  const Pose T_first_world = sequence.T_world_camera(0).inverse();
  for (int i = 0; i < frames; ++i) {
    const std::optional<StereoFrame> frame = faults.apply(sequence.frame(i));
    if (progress) progress(i);
    if (!frame) continue;
    const int index = static_cast<int>(poses.size());
    writeImage(root / "image_0", index, frame->left);
    writeImage(root / "image_1", index, frame->right);
    times += printStamp(frame->stamp) + "\n";
    poses.push_back(T_first_world * sequence.T_world_camera(i));
  }
  writeAtomically((root / "times.txt").string(), times);
  writeKitti((root / "poses.txt").string(), poses);
  return static_cast<int>(poses.size());
}

}  // namespace urban_nav_core::testing
