// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Patch number of returns that belong to no patch.
constexpr std::uint32_t kNoPatch = 0xffffffffU;

/// Partition of an image into superpixels.
struct Superpixels {
  cv::Mat numbers;  ///< CV_32S, per pixel: 0 ... count - 1
  int count = 0;
};

/// Segments an image by SLIC (Achanta et al. 2012). `size`: edge of a superpixel, px.
Superpixels makeSuperpixels(const cv::Mat& image, int size);

/// Groups the returns of a scene that are classified jointly: those of one superpixel at similar depth, or without an
/// image those in one cube of 0.4 m. Returns one number per return, kNoPatch for those in no group.
std::vector<std::uint32_t> makePatches(const Scene& scene, const Superpixels& superpixels);

}  // namespace scene_labeler
