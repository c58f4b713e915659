// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/superpixels.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/slic.hpp>

#include "urban_nav_registration/cloud/cell_table.hpp"

namespace scene_labeler {
namespace {

constexpr int kSlicIterations = 5;
constexpr float kSlicRuler = 15.0F;   // compactness
constexpr float kDepthRatio = 1.15F;  // between consecutive depths: a larger ratio begins a new patch
constexpr float kPatchCube = 0.4F;    // m

std::vector<std::uint32_t> cubePatches(const std::vector<Eigen::Vector3f>& points) {
  std::vector<std::uint32_t> patches(points.size(), kNoPatch);
  urban_nav_registration::CellTable table(points.size() / 16 + 16);
  const float limit = kPatchCube * static_cast<float>(urban_nav_registration::kFarthestCell);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite() && points[i].cwiseAbs().maxCoeff() < limit)
      patches[i] =
          table.insert(urban_nav_registration::toKey(urban_nav_registration::toCell(points[i], 1.0F / kPatchCube)));
  return patches;
}

}  // namespace

Superpixels makeSuperpixels(const cv::Mat& image, int size) {
  Superpixels result;
  if (image.empty()) return result;
  cv::Mat smooth, lab;
  cv::GaussianBlur(image, smooth, {3, 3}, 0.0);
  cv::cvtColor(smooth, lab, cv::COLOR_BGR2Lab);
  const auto slic = cv::ximgproc::createSuperpixelSLIC(lab, cv::ximgproc::SLIC, size, kSlicRuler);
  slic->iterate(kSlicIterations);
  slic->enforceLabelConnectivity(25);
  slic->getLabels(result.numbers);
  result.count = slic->getNumberOfSuperpixels();
  return result;
}

std::vector<std::uint32_t> makePatches(const Scene& scene, const Superpixels& superpixels) {
  if (superpixels.numbers.empty()) return cubePatches(scene.points);
  std::vector<std::uint32_t> patches(scene.points.size(), kNoPatch);
  const std::vector<std::uint8_t>& visible = scene.view.is_visible;
  std::vector<std::vector<std::uint32_t>> members(static_cast<std::size_t>(superpixels.count));
  for (std::uint32_t i = 0; i < visible.size(); ++i) {
    if (visible[i] == 0) continue;
    const int number = superpixels.numbers.at<int>(static_cast<int>(std::lround(scene.view.pixels[i].y())),
                                                   static_cast<int>(std::lround(scene.view.pixels[i].x())));
    members[static_cast<std::size_t>(number)].push_back(i);
  }
  std::uint32_t next = 0;
  for (std::vector<std::uint32_t>& returns : members) {
    std::stable_sort(returns.begin(), returns.end(), [&scene](std::uint32_t a, std::uint32_t b) {
      return scene.view.depths[a] < scene.view.depths[b];
    });
    for (std::size_t i = 0; i < returns.size(); ++i) {
      const bool begins = i == 0 || scene.view.depths[returns[i]] > kDepthRatio * scene.view.depths[returns[i - 1]];
      if (begins) ++next;
      patches[returns[i]] = next - 1;
    }
  }
  return patches;
}

}  // namespace scene_labeler
