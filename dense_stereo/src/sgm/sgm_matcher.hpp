// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dense_stereo/matcher.hpp"
#include "dense_stereo/parameters.hpp"
#include "filter/components.hpp"
#include "filter/depth_edges.hpp"
#include "filter/unsupported_regions.hpp"
#include "refine/floats.hpp"
#include "refine/slanted_alignment.hpp"
#include "sgm/bytes.hpp"
#include "sgm/semi_global.hpp"

namespace dense_stereo {

/// Method `sgm`: semi-global matching to integer disparities, removal of small components, then two steps of slanted
/// alignment, whose residuals determine the variance and the valid pixels.
class SgmMatcher final : public Matcher {
 public:
  explicit SgmMatcher(const Parameters& parameters) : parameters_(parameters) {}
  void match(const MatcherInput& input, DisparityImage& image) override;

 private:
  Exposure compareBrightness(const MatcherInput& input) const;
  void finish(DisparityImage& image) const;

  Parameters parameters_;
  SemiGlobal<Bytes> semi_global_;
  Winners winners_;
  SmallComponents components_;
  DepthEdges depth_edges_;
  Padded<std::uint8_t> edges_;
  Padded<float> start_;
  SlantedAlignment<Floats> alignment_;
  UnsupportedRegions unsupported_;
  DisparityField field_;
};

}  // namespace dense_stereo
