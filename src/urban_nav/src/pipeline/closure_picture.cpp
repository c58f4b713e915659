// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/closure_picture.hpp"

#include <algorithm>

#include "loop_metric/evidence.hpp"
#include "loop_metric/match_picture.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using loop_metric::Evidence;

namespace {

std::optional<Evidence::Try> viewsOf(const urban_nav_core::MetricClosure& closure) {
  Evidence evidence;
  try {
    evidence = loop_metric::parseEvidence(loop_metric::evidenceIn(closure.evidence));
  } catch (const urban_nav_core::UserError&) {
    return std::nullopt;
  }
  const auto decided = [](const Evidence::Try& each) { return each.method == "stereo" && each.verdict == "accepted"; };
  auto views = std::find_if(evidence.tries.begin(), evidence.tries.end(), decided);
  if (views == evidence.tries.end())
    views = std::find_if(evidence.tries.begin(), evidence.tries.end(),
                         [](const Evidence::Try& each) { return each.method == "stereo"; });
  if (views == evidence.tries.end()) return std::nullopt;
  return *views;
}

std::string titleOf(const urban_nav_core::PoseRef& view) {
  return view.session + " " + urban_nav_core::printStamp(view.stamp);
}

}  // namespace

bool hasViews(const urban_nav_core::MetricClosure& closure) { return viewsOf(closure).has_value(); }

std::optional<PagePicture> pictureOf(const urban_nav_core::MetricClosure& closure,
                                     const loop_metric::Surroundings& surroundings) {
  const std::optional<Evidence::Try> views = viewsOf(closure);
  if (!views) return std::nullopt;
  return pictureOf(*views, [&](bool of_a) { return surroundings.keyframe(of_a ? views->view_a : views->view_b); });
}

std::optional<PagePicture> pictureOf(const Evidence::Try& views,
                                     const std::function<loop_metric::Keyframe(bool of_a)>& keyframe) {
  loop_metric::MatchPictureOptions options;
  options.title_a = titleOf(views.view_a);
  options.title_b = titleOf(views.view_b);
  try {
    const loop_metric::Picture drawn = loop_metric::drawMatches(keyframe(true), keyframe(false), views.pixels, options);
    PagePicture picture;
    picture.jpeg = loop_metric::jpegOf(drawn);
    picture.width = drawn.width;
    picture.height = drawn.height;
    if (picture.jpeg.empty()) return std::nullopt;
    return picture;
  } catch (const urban_nav_core::UserError&) {  // a view that the store holds damaged
    return std::nullopt;
  }
}

}  // namespace urban_nav
