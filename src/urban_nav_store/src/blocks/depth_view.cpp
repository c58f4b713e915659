// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/tables/depth_view.hpp"

#include <algorithm>
#include <cmath>

#include "blocks/number_columns.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {

namespace {

constexpr float kUnitsPerPixel = 64.0F;
constexpr float kMostDisparityUnits = 65535.0F, kMostDeviationUnits = 255.0F;
constexpr std::size_t kSampleBytes = 4;
constexpr std::size_t kMostDepthBytes = std::size_t{1} << 28;

std::uint32_t disparityUnits(float value, float most) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(value * kUnitsPerPixel, 1.0F, most)));
}

}  // namespace

std::string DepthView::pack(const Samples& samples) {
  const std::size_t count = samples.disparity.size();
  std::vector<std::uint32_t> disparity(count, 0), sigma(count, 0), grey(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    grey[i] = samples.grey[i];
    if (!(samples.disparity[i] > 0.0F) || !(samples.sigma[i] > 0.0F)) continue;
    disparity[i] = disparityUnits(samples.disparity[i], kMostDisparityUnits);
    sigma[i] = disparityUnits(samples.sigma[i], kMostDeviationUnits);
  }
  std::string bytes;
  bytes.reserve(2 * sizeof(std::uint32_t) + kSampleBytes * count);
  appendInteger32(bytes, static_cast<std::uint32_t>(samples.width));
  appendInteger32(bytes, static_cast<std::uint32_t>(samples.height));
  appendColumn(bytes, disparity, 2);
  appendColumn(bytes, sigma, 1);
  appendColumn(bytes, grey, 1);
  return deflated(bytes);
}

DepthView::Samples DepthView::samples() const {
  const auto refuse = [&] {
    throw urban_nav_core::DataError("depth_view", std::to_string(packed.size()) + " bytes are not a depth image", "");
  };
  const std::optional<std::string> bytes = inflated(packed, kMostDepthBytes);
  if (!bytes) refuse();
  ByteReader reader(*bytes);
  const std::size_t width = reader.integer32(), height = reader.integer32();
  if (!reader.ok() || reader.left() % kSampleBytes != 0 || width * height != reader.left() / kSampleBytes) refuse();
  const std::size_t count = width * height;
  std::string_view rest = std::string_view(*bytes).substr(bytes->size() - reader.left());
  const std::vector<std::uint32_t> disparity = takeColumn(rest, count, 2), sigma = takeColumn(rest, count, 1),
                                   grey = takeColumn(rest, count, 1);
  Samples samples;
  samples.width = static_cast<int>(width);
  samples.height = static_cast<int>(height);
  for (std::size_t i = 0; i < count; ++i) {
    samples.disparity.push_back(static_cast<float>(disparity[i]) / kUnitsPerPixel);
    samples.sigma.push_back(static_cast<float>(sigma[i]) / kUnitsPerPixel);
    samples.grey.push_back(static_cast<std::uint8_t>(grey[i]));
  }
  return samples;
}

}  // namespace urban_nav_store
