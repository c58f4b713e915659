// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dense_stereo/matcher.hpp"
#include "dense_stereo/parameters.hpp"
#include "filter/components.hpp"
#include "padded.hpp"
#include "paper/log_filter.hpp"
#include "paper/supporting_windows.hpp"
#include "paper/words.hpp"

namespace dense_stereo {

/// Method `paper` (Newman et al. 2009, section 6.2): Laplacian of Gaussian, supporting windows, left/right check,
/// rejection of flat correlation curves, parabola through the minimum, removal of small components. The variance is
/// derived from the parabola's curvature.
class PaperMatcher final : public Matcher {
 public:
  explicit PaperMatcher(const Parameters& parameters) : parameters_(parameters) {}
  void match(const MatcherInput& input, DisparityImage& image) override;

 private:
  void matchRow(const ScoreRow& row, int v, int disparities, DisparityImage& image);

  Parameters parameters_;
  LogFilter filter_;
  Padded<std::uint8_t> left_, right_;
  SupportingWindows<Words> windows_;
  Padded<std::uint16_t> whole_;  ///< rounded disparities, 65535 for invalid
  SmallComponents components_;
};

}  // namespace dense_stereo
