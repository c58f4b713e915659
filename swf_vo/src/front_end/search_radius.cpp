// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/search_radius.hpp"

#include <algorithm>
#include <cstddef>

namespace swf_vo {

namespace {

constexpr double kFirst = 3.0;  // times the parameter, while the motion is unknown
// Radius from the errors of the prediction in the previous frame: minimum and offset (px), and factor on the 90 %
// quantile.
constexpr double kLeast = 8.0, kPerError = 3.0, kOffset = 4.0;
constexpr double kSigmas = 2.0;
// Share of the image width, about the disparity of the nearest landmarks.
constexpr double kWidestSearch = 0.16;

/// Returns a quantile; reorders the values. Requires at least one.
double takeQuantile(std::vector<double>& values, std::size_t percent) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * percent / 100);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

void SearchRadius::setUnknown() { radius_ = kFirst * usual_; }

void SearchRadius::setLimit(double sigma_m, const urban_nav_core::Pose& T_camera_odom,
                            const std::vector<Match>& matches) {
  constexpr std::size_t kNearer = 75;
  limit_ = usual_;
  inverse_depths_.clear();
  for (const Match& match : matches) {
    const double depth = (T_camera_odom.q() * match.p_odom.head<3>() + T_camera_odom.t() * match.p_odom.w()).z();
    if (depth > 0.0) inverse_depths_.push_back(std::max(0.0, match.p_odom.w()) / depth);
  }
  if (inverse_depths_.empty()) return;
  const double nearer = takeQuantile(inverse_depths_, kNearer);
  limit_ = std::clamp(kSigmas * sigma_m * camera_.fx * nearer, usual_, std::max(usual_, widest()));
}

bool SearchRadius::widen() {
  if (radius_ >= limit_) return false;
  radius_ = limit_;
  return true;
}

void SearchRadius::learn(std::vector<double>& errors) {
  constexpr std::size_t kNearlyAll = 90;
  if (errors.empty()) return;
  const double most = std::max(usual_, limit_);
  radius_ = std::clamp(kPerError * takeQuantile(errors, kNearlyAll) + kOffset, std::min(kLeast, usual_), most);
}

double SearchRadius::anywhere() const { return std::max(kFirst * usual_, widest()); }

double SearchRadius::widest() const { return kWidestSearch * camera_.width; }

void SearchRadius::archive(urban_nav_core::Archive& archive) {
  archive(radius_);
  archive.require(radius_ >= 0.0 && radius_ <= anywhere(), "search radius out of range");
}

}  // namespace swf_vo
