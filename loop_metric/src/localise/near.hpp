// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "loop_metric/localiser.hpp"

namespace loop_metric {

/// Does it say which places of a map are near? What is KNOWN does, and a belief that is not too vague; a single sighting does not, since it may be false.
inline bool tellsWhatIsNear(const Located& located) {
  constexpr double useful_belief = 2.0;  // m
  if (!located.T_map_base) return false;
  if (located.knowledge == Knowledge::Known) return true;
  return located.witnesses == 0 &&
         located.T_map_base->covariance.topLeftCorner<3, 3>().trace() <= useful_belief * useful_belief;
}

}  // namespace loop_metric
