// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/sequence_folder.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::testing {
namespace {

namespace fs = std::filesystem;

std::string imagePath(const fs::path& folder, std::size_t index) {
  std::string name = std::to_string(index);
  name.insert(0, 6 - std::min<std::size_t>(6, name.size()), '0');
  return (folder / (name + ".png")).string();
}

void writeImage(const std::string& path, const GreyImage& image) {
  if (image.pixels.empty()) return;  // a missing image is a missing file
  PartialFile file(path);
  const cv::Mat pixels(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data()));
  if (!cv::imwrite(file.path(), pixels)) throw std::runtime_error("cannot write " + file.path());
  file.commit();
}

GreyImage readImage(const std::string& path) {
  const cv::Mat pixels = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (pixels.empty()) return {};
  return {pixels.cols, pixels.rows,
          std::vector<std::uint8_t>(pixels.begin<std::uint8_t>(), pixels.end<std::uint8_t>())};
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
    writeImage(imagePath(root / "image_0", poses.size()), frame->left);
    writeImage(imagePath(root / "image_1", poses.size()), frame->right);
    times += printStamp(frame->stamp) + "\n";
    poses.push_back(T_first_world * sequence.T_world_camera(i));
  }
  writeAtomically((root / "times.txt").string(), times);
  writeKitti((root / "poses.txt").string(), poses);
  return static_cast<int>(poses.size());
}

Recording record(RenderedSequence& sequence, int frames) {
  const RenderCamera& c = sequence.options().camera;
  Recording recording;
  recording.camera = {{c.fx, c.fy, c.cx, c.cy, c.width, c.height}, c.baseline};
  const Pose T_first_world = sequence.T_world_camera(0).inverse();
  for (int i = 0; i < frames; ++i) {
    recording.frames.push_back(sequence.frame(i));
    recording.truth.push_back(T_first_world * sequence.T_world_camera(i));
  }
  return recording;
}

Recording readSequenceFolder(const std::string& folder, std::size_t first, std::size_t count) {
  const fs::path root = folder;
  const std::vector<StampNs> stamps = readTimes((root / "times.txt").string());
  const std::vector<Pose> poses = readKitti((root / "poses.txt").string());
  const std::size_t end = std::min(stamps.size(), poses.size());
  if (first >= end) throw UserError(folder, "frame " + std::to_string(first), "fewer than " + std::to_string(end));
  Recording recording;
  int width = 0, height = 0;
  for (std::size_t i = first; i < end && recording.frames.size() < count; ++i) {
    recording.frames.push_back(
        {stamps[i], readImage(imagePath(root / "image_0", i)), readImage(imagePath(root / "image_1", i))});
    recording.truth.push_back(poses[first].inverse() * poses[i]);
    width = std::max(width, recording.frames.back().left.width);
    height = std::max(height, recording.frames.back().left.height);
  }
  recording.camera = readKittiCalibration((root / "calib.txt").string(), width, height);
  return recording;
}

std::string dataFolder(const std::string& name) {
  const char* root = std::getenv("URBAN_NAV_DATA");
  if (root == nullptr || *root == '\0') return {};
  const std::string folder = (fs::path(root) / name).string();
  return fs::is_directory(folder) ? folder : std::string();
}

}  // namespace urban_nav_core::testing
