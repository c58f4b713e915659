// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/closure_picture.hpp"

#include "loop_metric/evidence.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/pictures/cloud_picture.hpp"
#include "urban_nav_registration/pictures/match_picture.hpp"

namespace urban_nav {

using loop_metric::Evidence;
using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;

namespace {

bool isShown(const Evidence::Try& tried) {
  return tried.method == ClosureMethod::Stereo || (tried.guess && tried.T_a_b);
}

std::optional<Evidence::Try> findShown(const urban_nav_core::MetricClosure& closure) {
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
    if (tried.verdict == ClosureVerdict::Accepted || tried.verdict == ClosureVerdict::Degenerate)
      shown = &tried;  // later attempts are made only without success
  }
  if (shown == nullptr) return std::nullopt;
  return *shown;
}

std::string makeTitle(const urban_nav_core::PoseRef& view) {
  return view.session + " " + urban_nav_core::printStamp(view.stamp);
}

}  // namespace

bool hasPicture(const urban_nav_core::MetricClosure& closure) { return findShown(closure).has_value(); }

std::optional<PagePicture> toPicture(const urban_nav_core::MetricClosure& closure,
                                     const loop_metric::PlaceData& place_data, double way) {
  const std::optional<Evidence::Try> shown = findShown(closure);
  if (!shown) return std::nullopt;
  return toPicture(*shown, place_data, way);
}

std::optional<PagePicture> toPicture(const Evidence::Try& tried, const loop_metric::PlaceData& place_data, double way) {
  if (!isShown(tried)) return std::nullopt;
  try {
    urban_nav_registration::Picture drawn;
    if (tried.method == ClosureMethod::Stereo) {
      urban_nav_registration::MatchPictureOptions options;
      options.title_a = makeTitle(tried.keyframe_a);
      options.title_b = makeTitle(tried.keyframe_b);
      drawn = urban_nav_registration::drawMatches(place_data.keyframe(tried.keyframe_a),
                                                  place_data.keyframe(tried.keyframe_b), tried.pixels, options);
    } else {
      urban_nav_registration::CloudPictureOptions options;
      options.caption = "red: " + makeTitle(tried.keyframe_a) + "; blue: " + makeTitle(tried.keyframe_b);
      drawn = urban_nav_registration::drawClouds(place_data.cloud(tried.keyframe_b, way),
                                                 place_data.cloud(tried.keyframe_a, way), *tried.guess, *tried.T_a_b,
                                                 options);
    }
    PagePicture picture;
    picture.jpeg = urban_nav_registration::encodeJpeg(drawn);
    picture.width = drawn.width;
    picture.height = drawn.height;
    if (picture.jpeg.empty()) return std::nullopt;
    return picture;
  } catch (const urban_nav_core::Error&) {  // damaged data in the store
    return std::nullopt;
  }
}

}  // namespace urban_nav
