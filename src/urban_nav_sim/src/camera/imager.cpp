// SPDX-License-Identifier: BSD-3-Clause
#include "camera/imager.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {

Imager::Imager(const Lens& lens, const Settings& settings, const Noise& noise)
    : rays_(lens), settings_(settings), noise_(noise) {
  const double half_width = lens.width / 2.0, half_height = lens.height / 2.0;
  const double corner2 = half_width * half_width + half_height * half_height;
  for (int v = 0; v < lens.height; ++v) {
    for (int u = 0; u < lens.width; ++u) {
      const double du = u - lens.cx, dv = v - lens.cy, share = (du * du + dv * dv) / corner2;
      vignetting_.push_back(static_cast<float>(1.0 - settings.vignetting * std::min(share, 1.2)));
    }
  }
  for (std::size_t i = 0; i < curve_.size(); ++i) {
    const double level = std::min(1.0, static_cast<double>(i) / 4.0 / 255.0);
    curve_[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(level, settings.gamma)));
  }
}

void Imager::developRow(const Picture& picture, const std::vector<float>& radiance, int v, float levels, float gain,
                        const Noise& noise, std::uint8_t* out) const {
  constexpr float kBrightest = 40.0F;  // larger values would only increase rounding errors
  const int channels = picture.channels, width = picture.width * channels;
  const auto side = static_cast<float>(std::exp(-0.5 / (settings_.spread * settings_.spread)));
  const float a = side / (1.0F + 2.0F * side), b = 1.0F / (1.0F + 2.0F * side);
  const auto row = [&](int y) {
    return &radiance[picture.at(0, std::clamp(y, 0, picture.height - 1)) * static_cast<std::size_t>(channels)];
  };
  const float *above = row(v - 1), *here = row(v), *below = row(v + 1);
  // A margin of one pixel on each side, to avoid special cases of the spread along the row.
  std::vector<float> sums(static_cast<std::size_t>(width + 2 * channels));
  float* sum = sums.data() + channels;
  for (int i = 0; i < width; ++i) sum[i] = std::min(a * (above[i] + below[i]) + b * here[i], kBrightest);
  for (int i = 0; i < channels; ++i) {
    sum[i - channels] = sum[i];
    sum[width + i] = sum[width + i - channels];
  }
  const float* vignetting = &vignetting_[picture.at(0, v)];
  const auto scale = levels * static_cast<float>(settings_.sensitivity);
  const auto read2 = static_cast<float>(settings_.read_noise * settings_.read_noise) * gain * gain;
  const float shot = static_cast<float>(settings_.shot_noise) * gain;
  const bool is_linear = settings_.gamma == 1.0;
  for (int i = 0; i < width; ++i) {
    const int pixel = i / channels, channel = i % channels;
    float level = (a * (sum[i - channels] + sum[i + channels]) + b * sum[i]) * scale * vignetting[pixel];
    if (settings_.is_noisy) {
      const auto counter = static_cast<std::uint64_t>(v * width + i);
      level += std::sqrt(read2 + shot * std::min(level, 300.0F)) * noise.roughNormal(counter);
    }
    if (channels == 3) level *= settings_.white_balance[channel];
    level = std::clamp(level, 0.0F, 255.0F);
    const int target = channels == 3 ? i - channel + 2 - channel : i;  // OpenCV's colours: blue, green, red
    // A level is not negative, and lround is a call for each pixel.
    // NOLINTNEXTLINE(bugprone-incorrect-roundings)
    const auto steps = static_cast<std::size_t>((is_linear ? level : 4.0F * level) + 0.5F);
    out[target] = is_linear ? static_cast<std::uint8_t>(steps) : curve_[steps];
  }
}

cv::Mat Imager::develop(const Picture& picture, const CameraMotion& motion, const Exposure& exposure, double levels,
                        std::uint64_t number) {
  if (settings_.blurs) blurByMotion(picture, rays_, motion, exposure.seconds, smeared_);
  const std::vector<float>& radiance = settings_.blurs ? smeared_ : picture.radiance;
  cv::Mat image(picture.height, picture.width, picture.channels == 1 ? CV_8UC1 : CV_8UC3);
  const Noise noise = noise_.of(number);
  urban_nav_core::forEach(static_cast<std::size_t>(picture.height), 8, [&](std::size_t row) {
    const int v = static_cast<int>(row);
    developRow(picture, radiance, v, static_cast<float>(levels), static_cast<float>(exposure.gain), noise,
               image.ptr(v));
  });
  return image;
}

}  // namespace urban_nav_sim
