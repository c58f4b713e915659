// SPDX-License-Identifier: BSD-3-Clause
#include "own_method.hpp"

#include "urban_nav_core/types/error.hpp"

namespace dense_stereo {

void requireOwnMethod(const Parameters& parameters) {
  if (parameters.method == "sgm") return;
  throw urban_nav_core::UserError("", "dense_stereo.method = " + parameters.method,
                                  "sgm; others, for comparison, in `urban_nav disparity` and `urban_nav map` only");
}

}  // namespace dense_stereo
