// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/rectification_judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "urban_nav_ros/image.hpp"

namespace urban_nav_ros {

using urban_nav_core::CameraInfo;
using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kMostImages = 40;

cv::Mat decode(const ImageInput& image, const GreyScale& scale) {
  return std::visit([&scale](const auto& message) { return toGrey(*message, scale).pixels; }, image.message);
}

}  // namespace

RectificationJudge::RectificationJudge(bool as_named, bool by_images, double sync_tolerance)
    : as_named_(as_named),
      by_images_(by_images),
      sync_tolerance_(static_cast<StampNs>(std::llround(sync_tolerance * 1e9))) {}

void RectificationJudge::add(const ImageInput& image) {
  if (!by_images_ || answer_) return;
  seen_.push_back(image);
  if (seen_.size() > kMostImages) seen_.pop_front();
}

std::vector<ImagePair> RectificationJudge::decodePairs() const {
  GreyRange range;
  for (const ImageInput& image : seen_)
    std::visit([&range](const auto& message) { range.add(*message); }, image.message);
  std::vector<ImagePair> pairs;
  for (const ImageInput& left : seen_) {
    if (left.side != Side::Left || pairs.size() >= static_cast<std::size_t>(kJudgedPairs)) continue;
    for (const ImageInput& right : seen_) {
      if (right.side != Side::Right || std::abs(right.stamp - left.stamp) > sync_tolerance_) continue;
      ImagePair pair{decode(left, range.scale()), decode(right, range.scale())};
      if (!pair.first.empty() && pair.second.size() == pair.first.size()) pairs.push_back(std::move(pair));
      break;
    }
  }
  return pairs;
}

std::optional<bool> RectificationJudge::decide(const CameraInfo& left, const CameraInfo& right,
                                               const std::string& where, bool must_decide) {
  if (answer_) return answer_;
  if (!by_images_) return as_named_;
  const StereoCalibration rectifying(left, right, false, where);
  if (!rectifying.rectifies()) return answer_ = as_named_;
  const auto lefts =
      std::count_if(seen_.begin(), seen_.end(), [](const auto& image) { return image.side == Side::Left; });
  const auto rights = static_cast<std::ptrdiff_t>(seen_.size()) - lefts;
  const bool is_enough = std::min(lefts, rights) >= kJudgedPairs || seen_.size() >= kMostImages;
  if (!is_enough && !must_decide) return std::nullopt;
  const RectificationChoice choice = chooseRectification(decodePairs(), rectifying);
  contradiction_ = choice.contradiction(as_named_);
  seen_.clear();
  return answer_ = choice.isRectified(as_named_);
}

void RectificationJudge::reset() {
  seen_.clear();
  answer_.reset();
  contradiction_.clear();
}

}  // namespace urban_nav_ros
