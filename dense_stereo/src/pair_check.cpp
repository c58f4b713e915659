// SPDX-License-Identifier: BSD-3-Clause
#include "pair_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "urban_nav_core/image/exchanged.hpp"

namespace dense_stereo {

using urban_nav_core::ImageView;

namespace {

// With less contrast an 8-bit image contains only noise.
constexpr double kLeastContrast = 2.0;  // grey levels
constexpr double kExposureWarning = 1.25;

struct Brightness {
  double mean = 0.0, deviation = 0.0;  // grey levels
};

/// Measures every fourth pixel of every second row.
Brightness measureBrightness(const ImageView& image) {
  std::int64_t sum = 0, squares = 0, count = 0;
  for (int v = 0; v < image.height; v += 2) {
    const std::uint8_t* row = image.row(v);
    for (int u = v / 2 % 4; u < image.width; u += 4) {
      sum += row[u];
      squares += row[u] * row[u];
      ++count;
    }
  }
  const double n = static_cast<double>(std::max<std::int64_t>(count, 1)), mean = static_cast<double>(sum) / n;
  return {mean, std::sqrt(std::max(0.0, static_cast<double>(squares) / n - mean * mean))};
}

std::string toSize(const ImageView& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

PairCheck refuse(Reason reason, std::string sentence) { return {reason, std::move(sentence), false, 1.0, 0.0}; }

}  // namespace

PairCheck checkPair(const urban_nav_core::StereoPair& pair, bool may_be_swapped) {
  if (pair.left.empty() || pair.right.empty())
    return refuse(Reason::ImageMissing, pair.left.empty() ? "the left image is missing" : "the right image is missing");
  if (pair.left.width != pair.right.width || pair.left.height != pair.right.height)
    return refuse(Reason::SizesDiffer, "left image " + toSize(pair.left) + ", right image " + toSize(pair.right));
  const Brightness left = measureBrightness(pair.left), right = measureBrightness(pair.right);
  if (std::min(left.deviation, right.deviation) < kLeastContrast)
    return refuse(Reason::NoContrast,
                  std::string(left.deviation < right.deviation ? "left" : "right") + " image without contrast");
  if (may_be_swapped && urban_nav_core::looksExchanged(pair.left, pair.right))
    return refuse(Reason::Swapped, "left and right images are swapped: disparities are negative");
  PairCheck check;
  check.exposure = left.deviation / right.deviation;
  check.offset = left.mean - check.exposure * right.mean;
  const double ratio = (left.mean + 1.0) / (right.mean + 1.0);
  if (ratio > kExposureWarning || ratio < 1.0 / kExposureWarning) {
    char text[80];
    std::snprintf(text, sizeof text, "left image %.2f times as bright as the right one", ratio);
    check.reason = Reason::ExposureDiffers;
    check.sentence = text;
  }
  return check;
}

}  // namespace dense_stereo
