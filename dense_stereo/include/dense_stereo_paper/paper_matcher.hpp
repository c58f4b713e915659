// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "dense_stereo/matcher.hpp"
#include "dense_stereo/parameters.hpp"

namespace dense_stereo {

/// Returns the local matcher of Newman et al. 2009, section 6.2, if `Parameters::method` is "paper"; otherwise null,
/// which selects semi-global matching in the constructors of DenseStereo and NearSceneEstimator.
std::unique_ptr<Matcher> makePaperMatcher(const Parameters& parameters);

}  // namespace dense_stereo
