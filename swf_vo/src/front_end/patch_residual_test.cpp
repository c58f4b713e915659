// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/patch_residual_test.hpp"

#include <algorithm>

#include "robust_threshold.hpp"

namespace swf_vo {

namespace {

constexpr std::size_t kRenewal = 8;  // patches between two updates of the median

}  // namespace

bool PatchResidualTest::isTypical(double noise) {
  recent_[count_ % kSize] = noise;
  ++count_;
  if (count_ < kEnough) return true;
  if (limit_ == 0.0 || count_ % kRenewal == 0) {
    const std::size_t known = std::min(count_, kSize);
    std::copy_n(recent_.begin(), known, sorted_.begin());
    limit_ = robustThreshold(sorted_.begin(), sorted_.begin() + static_cast<std::ptrdiff_t>(known));
  }
  return noise <= limit_;
}

void PatchResidualTest::archive(urban_nav_core::Archive& archive) { archive(recent_, count_, limit_); }

}  // namespace swf_vo
