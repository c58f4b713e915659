// SPDX-License-Identifier: BSD-3-Clause
#include "stages/loops/closure_picture.hpp"

#include "loop_metric/cloud_picture.hpp"
#include "loop_metric/evidence.hpp"
#include "loop_metric/match_picture.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using loop_metric::Evidence;

namespace {

bool isShown(const Evidence::Try& tried) { return tried.method == "stereo" || (tried.guess && tried.T_a_b); }

std::optional<Evidence::Try> shownOf(const urban_nav_core::MetricClosure& closure) {
  Evidence evidence;
  try {
    evidence = loop_metric::parseEvidence(loop_metric::evidenceIn(closure.evidence));
  } catch (const urban_nav_core::DataError&) {
    return std::nullopt;
  }
  const Evidence::Try* shown = nullptr;
  for (const Evidence::Try& tried : evidence.tries) {
    if (!isShown(tried)) continue;
    if (shown == nullptr) shown = &tried;
    if (tried.verdict == "accepted" || tried.verdict == "degenerate")
      shown = &tried;  // later ones are had only without
  }
  if (shown == nullptr) return std::nullopt;
  return *shown;
}

std::string titleOf(const urban_nav_core::PoseRef& view) {
  return view.session + " " + urban_nav_core::printStamp(view.stamp);
}

}  // namespace

bool hasPicture(const urban_nav_core::MetricClosure& closure) { return shownOf(closure).has_value(); }

std::optional<PagePicture> pictureOf(const urban_nav_core::MetricClosure& closure,
                                     const loop_metric::Surroundings& surroundings, double way) {
  const std::optional<Evidence::Try> shown = shownOf(closure);
  if (!shown) return std::nullopt;
  return pictureOf(*shown, surroundings, way);
}

std::optional<PagePicture> pictureOf(const Evidence::Try& tried, const loop_metric::Surroundings& surroundings,
                                     double way) {
  if (!isShown(tried)) return std::nullopt;
  try {
    loop_metric::Picture drawn;
    if (tried.method == "stereo") {
      loop_metric::MatchPictureOptions options;
      options.title_a = titleOf(tried.view_a);
      options.title_b = titleOf(tried.view_b);
      drawn = loop_metric::drawMatches(surroundings.keyframe(tried.view_a), surroundings.keyframe(tried.view_b),
                                       tried.pixels, options);
    } else {
      loop_metric::CloudPictureOptions options;
      options.caption = "red: " + titleOf(tried.view_a) + "; blue: " + titleOf(tried.view_b);
      drawn = loop_metric::drawClouds(surroundings.cloud(tried.view_b, way), surroundings.cloud(tried.view_a, way),
                                      *tried.guess, *tried.T_a_b, options);
    }
    PagePicture picture;
    picture.jpeg = loop_metric::jpegOf(drawn);
    picture.width = drawn.width;
    picture.height = drawn.height;
    if (picture.jpeg.empty()) return std::nullopt;
    return picture;
  } catch (const urban_nav_core::Error&) {  // what the store holds is damaged
    return std::nullopt;
  }
}

}  // namespace urban_nav
