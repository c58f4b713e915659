// SPDX-License-Identifier: BSD-3-Clause
#include "chain.hpp"

namespace swf_vo::bench {

urban_nav_core::OdometryChain makeChain(const Sequence& sequence, const Run& run) {
  urban_nav_core::OdometryChain chain;
  for (std::size_t i = 1; i < run.settled.size(); ++i) {
    urban_nav_core::RelativePose step;
    step.from = sequence.stamps[i - 1];
    step.to = sequence.stamps[i];
    step.T_from_to = run.settled[i - 1].inverse() * run.settled[i];
    step.covariance = run.relative_covariance[i];
    step.drift_covariance = run.drift_covariance[i];
    chain.append(step);
  }
  return chain;
}

}  // namespace swf_vo::bench
