// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/depth_view.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace urban_nav_ros {

namespace {

constexpr std::uint64_t kMostViewSamples = 4'000'000;
constexpr std::uint32_t kLargestViewStep = 1000;  // px

}  // namespace

urban_nav_msgs::DepthView toDepthViewMessage(urban_nav_core::DepthSamples samples, const std_msgs::Header& header) {
  urban_nav_msgs::DepthView message;
  message.header = header;
  message.fx = samples.fx;
  message.fy = samples.fy;
  message.cx = samples.cx;
  message.cy = samples.cy;
  message.baseline = samples.baseline;
  message.step = static_cast<std::uint32_t>(samples.step);
  message.width = static_cast<std::uint32_t>(samples.width);
  message.height = static_cast<std::uint32_t>(samples.height);
  message.disparity = std::move(samples.disparity);
  message.sigma = std::move(samples.sigma);
  message.grey = std::move(samples.grey);
  return message;
}

std::optional<urban_nav_core::DepthSamples> toDepthSamples(const urban_nav_msgs::DepthView& message) {
  const std::uint64_t samples = static_cast<std::uint64_t>(message.width) * message.height;
  if (samples == 0 || samples > kMostViewSamples || message.disparity.size() != samples ||
      message.sigma.size() != samples || message.grey.size() != samples || message.step == 0 ||
      message.step > kLargestViewStep)
    return std::nullopt;
  if (!std::isfinite(message.cx) || !std::isfinite(message.cy)) return std::nullopt;
  for (const double number : {message.fx, message.fy, message.baseline})
    if (!std::isfinite(number) || number <= 0.0) return std::nullopt;
  for (std::size_t i = 0; i < samples; ++i)
    if (!std::isfinite(message.disparity[i]) || !std::isfinite(message.sigma[i])) return std::nullopt;
  urban_nav_core::DepthSamples view;
  view.fx = message.fx;
  view.fy = message.fy;
  view.cx = message.cx;
  view.cy = message.cy;
  view.baseline = message.baseline;
  view.step = static_cast<int>(message.step);
  view.width = static_cast<int>(message.width);
  view.height = static_cast<int>(message.height);
  view.disparity = message.disparity;
  view.sigma = message.sigma;
  view.grey = message.grey;
  return view;
}

}  // namespace urban_nav_ros
