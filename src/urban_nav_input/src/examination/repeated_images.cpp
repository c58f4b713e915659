// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/examination/repeated_images.hpp"

#include <algorithm>
#include <cstring>

namespace urban_nav_input {

using urban_nav_core::ImageView;
using urban_nav_core::StampNs;
using urban_nav_core::StereoPair;

namespace {

constexpr std::int64_t kShortRun = 3;  // consecutive repeated images of one camera while the other one changes
constexpr std::int64_t kLongRun = 20;  // consecutive pairs of which both images repeat, impossible with sensor noise
constexpr std::int64_t kFewRuns = 3;
constexpr double kManyRuns = 0.1;  // share of pairs at which images begin to repeat

bool isSame(const ImageView& a, const ImageView& b) {
  if (a.empty() || a.width != b.width || a.height != b.height) return false;
  if (a.data == b.data) return true;
  for (int v = 0; v < a.height; ++v)
    if (std::memcmp(a.row(v), b.row(v), static_cast<std::size_t>(a.width)) != 0) return false;
  return true;
}

/// Returns whether all pixels are equal, as in saturated images, which repeat without a fault.
bool isUniform(const ImageView& image) {
  const std::uint8_t first = *image.row(0);
  for (int v = 0; v < image.height; ++v)
    if (std::any_of(image.row(v), image.row(v) + image.width, [first](std::uint8_t value) { return value != first; }))
      return false;
  return true;
}

}  // namespace

void RepeatedImages::Count::add(bool is_repeated, StampNs stamp) {
  if (!is_repeated) {
    run = 0;
    return;
  }
  if (repeated++ == 0) first = stamp;
  if (run++ == 0) ++runs;
  longest = std::max(longest, run);
}

void RepeatedImages::add(const StereoPair& before, const StereoPair& now) {
  ++compared_;
  bool left = isSame(before.left, now.left), right = isSame(before.right, now.right);
  if (left && isUniform(now.left)) left = false;
  if (right && isUniform(now.right)) right = false;
  const bool is_complete = !now.left.empty() && !now.right.empty() && !before.left.empty() && !before.right.empty();
  counts_[0].add(left && !right && is_complete, now.stamp);
  counts_[1].add(right && !left && is_complete, now.stamp);
  counts_[2].add(left && right, now.stamp);
}

std::string RepeatedImages::share(const Count& count) const {
  return std::to_string(count.repeated) + " of " + std::to_string(compared_ + 1);
}

std::vector<Finding> RepeatedImages::findings() const {
  std::vector<Finding> findings;
  const auto has_many_runs = [this](const Count& count) {
    return count.runs >= kFewRuns && static_cast<double>(count.runs) > kManyRuns * static_cast<double>(compared_);
  };
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    const Count& count = counts_[side];
    if (count.longest < kShortRun && !has_many_runs(count)) continue;
    const std::string name = side == 0 ? "left" : "right";
    findings.push_back({FindingKind::Pairs,
                        share(count) + " " + name + " images repeat the previous one pixel by pixel, while the " +
                            (side == 0 ? "right" : "left") + " ones change, the first at " +
                            urban_nav_core::printStamp(count.first) + ": the camera or its driver is frozen",
                        "restart the driver of the " + name +
                            " camera; the images of these pairs are of different times and cannot be restored"});
  }
  const Count& both = counts_[2];
  if (has_many_runs(both))
    findings.push_back({FindingKind::Pairs,
                        share(both) + " stereo pairs repeat the previous one pixel by pixel: each is published more "
                                      "than once with different stamps",
                        "publish each pair once, at the rate of the cameras"});
  else if (both.longest >= kLongRun)
    findings.push_back({FindingKind::Pairs,
                        share(both) + " stereo pairs repeat the previous one pixel by pixel, the first at " +
                            urban_nav_core::printStamp(both.first) +
                            ": both cameras or their driver are frozen, or a noise-free simulator was at rest",
                        "restart the driver of the cameras; no action needed for a simulated robot at rest"});
  return findings;
}

}  // namespace urban_nav_input
