// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Packs a Bumblebee2 frame from grey images, for simulation: even bytes right, odd bytes left. Images of sizes other
/// than 640x480 are scaled. Without embedded words.
Bytes packBb2Frame(const cv::Mat& left, const cv::Mat& right);

/// Packs a Ladybug2 frame from upright colour images (BGR) of the five cameras of the ring, for simulation: four grey
/// JPEGs of 512x384 per camera in the order BGGR. An empty image is a camera without channels, as is the sixth.
/// `quality`: of the JPEGs, 1...100. Without time and sequence number.
Bytes packLadybugFrame(const std::array<cv::Mat, 5>& cameras, int quality);

}  // namespace segway_drivers
