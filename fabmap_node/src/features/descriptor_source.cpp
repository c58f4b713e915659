// SPDX-License-Identifier: BSD-3-Clause
#include "features/descriptor_source.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_registration/stereo/descriptor.hpp"

namespace fabmap_node {

bool describeAsBytes(const urban_nav_core::Pyramid& pyramid, const Eigen::Vector2d& centre, double window_px,
                     ByteDescriptor& descriptor) {
  const auto unit = urban_nav_registration::describe(pyramid, centre, window_px);
  if (!(unit.squaredNorm() > 0.5F)) return false;
  constexpr float kScale = 512.0F;
  for (std::size_t i = 0; i < kDescriptorBytes; ++i)
    descriptor[i] =
        static_cast<std::uint8_t>(std::clamp(std::lround(kScale * unit(static_cast<Eigen::Index>(i))), 0L, 255L));
  return true;
}

}  // namespace fabmap_node
