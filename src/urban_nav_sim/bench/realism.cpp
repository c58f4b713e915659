// SPDX-License-Identifier: BSD-3-Clause
// Compares images of each world with real streets: texture, corners, noise, gradients.
//   realism [--route NAME] [--duration S] [--frames N] [--seed N] [--day N] [--write FOLDER] [-o FILE.json]
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "camera/heads.hpp"
#include "camera/sky.hpp"
#include "motion/simulate_drive.hpp"
#include "ray_tracing/tracer.hpp"
#include "rig/sensor_poses.hpp"
#include "support/distribution.hpp"
#include "support/program.hpp"
#include "support/texture.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace {

using namespace urban_nav_sim;
using namespace urban_nav_sim::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

constexpr double kFewerPixels = 0.54;  // pixels per radian of the stereo camera relative to the real sequences
constexpr double kUpright = 14.6;      // deg above and below the horizon of the real cameras; 26 for the stereo camera
constexpr std::size_t kEvery = 8;      // of the real frames, which are similar

/// One value per picture; of gradients one per sampled pixel.
struct Textures {
  Values textured_blocks, corners, two_octaves_up, above, below, white, noise, gradients;

  void add(const Texture& texture) {
    textured_blocks.push_back(texture.textured_blocks);
    corners.push_back(texture.corners);
    two_octaves_up.push_back(texture.two_octaves_up);
    above.push_back(texture.above);
    below.push_back(texture.below);
    white.push_back(texture.white);
    noise.push_back(texture.noise);
    gradients.insert(gradients.end(), texture.gradients.begin(), texture.gradients.end());
  }
};

/// Returns textures at the resolution of the real camera, and at the pixels per radian of the simulated one, either of
/// which a simulated frame may match.
Textures realTextures() {
  Textures textures;
  for (const char* name : {"stereo/kitti06_000_050/image_0", "stereo/kitti_raw_0926_0005/image_0"}) {
    const std::string folder = realData(name);
    if (folder.empty()) continue;
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    for (std::size_t i = 0; i < files.size(); i += kEvery) {
      const cv::Mat image = cv::imread(files[i], cv::IMREAD_GRAYSCALE);
      cv::Mat smaller;
      cv::resize(image, smaller, cv::Size(), kFewerPixels, kFewerPixels, cv::INTER_AREA);
      textures.add(measureTexture(image));
      textures.add(measureTexture(smaller));
    }
  }
  return textures;
}

/// Crops an image to the vertical field of view of the real cameras, for equal shares of sky and ground.
cv::Mat asTheRealOnes(const cv::Mat& image, const Lens& lens) {
  const int middle = cvRound(lens.cy), half = cvRound(lens.fy * std::tan(kUpright * M_PI / 180.0));
  return image.rowRange(std::max(middle - half, 0), std::min(middle + half, image.rows));
}

Textures simulatedTextures(const std::string& name, const Options& options) {
  const auto seed = static_cast<std::uint32_t>(options.number("--seed", 7));
  const World world = buildWorld(name, seed, static_cast<int>(options.number("--day", 1)));
  DriveOptions ride_options;
  ride_options.duration = options.number("--duration", 300);
  ride_options.seed = seed;
  const auto motion = simulateDrive(world, makeRoute(name, seed, options.text("--route", "loops")), ride_options);
  const Tracer tracer(world);
  const Sky sky(world.day, seed);
  const int frames = static_cast<int>(options.number("--frames", 60));
  const std::string folder = options.text("--write", "");
  Textures textures;
  for (int i = 0; i < frames; ++i) {
    // One head per frame, with settled exposure, as in a sequence.
    StereoHead head(tracer, sky, StereoImages::Rectified, sensorPose(urban_nav_core::frames::kStereoLeft),
                    seed + static_cast<std::uint64_t>(i));
    const cv::Mat image = head.take(*motion, (i + 0.5) * motion->duration() / frames)[0];
    textures.add(measureTexture(asTheRealOnes(image, head.cameras()[0].lens)));
    if (!folder.empty()) cv::imwrite(folder + "/" + name + std::to_string(100 + i) + ".png", image);
  }
  return textures;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options(argc, argv);
  std::vector<std::string> columns = {"", "real"};
  const Textures real = realTextures();
  std::vector<Textures> simulated;
  for (const std::string& name : townNames()) {
    columns.push_back(name);
    columns.emplace_back("distance");
    simulated.push_back(simulatedTextures(name, options));
  }

  BenchTable table(columns, argc, argv);
  const auto add = [&](const std::string& what, Values Textures::*values, int decimals) {
    std::vector<std::string> row = {what, summary(real.*values, decimals)};
    for (const Textures& textures : simulated) {
      row.push_back(summary(textures.*values, decimals));
      row.push_back(cell(distributionDistance(textures.*values, real.*values), 2));
    }
    table.add(row);
  };
  add("textured blocks (share)", &Textures::textured_blocks, 2);
  add("FAST corners in 512x384", &Textures::corners, 0);
  add("gradient two octaves up over that at full size", &Textures::two_octaves_up, 2);
  add("... in the upper half", &Textures::above, 2);
  add("... in the lower half", &Textures::below, 2);
  add("burnt out (share)", &Textures::white, 2);
  add("noise (grey levels)", &Textures::noise, 2);
  add("log2(1 + gradient), every pixel", &Textures::gradients, 2);
  table.note(
      "Median (tenth ... ninth decile) over frames. Real: every eighth left image of kitti06_000_050 and "
      "kitti_raw_0926_0005, at full size and at the simulated camera's pixels a radian. Simulated: the rows in the "
      "field of view of the real cameras, 15 deg above and below the horizon. Distance: earth mover's, in units of the "
      "real standard deviation.");
  return show(table, options);
} catch (const std::exception& error) {
  return urban_nav_sim::bench::complain(error);
}
