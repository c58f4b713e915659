// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"

namespace swf_vo::bench {

/// The settled steps of a run, with their covariances.
urban_nav_core::OdometryChain makeChain(const Sequence& sequence, const Run& run);

}  // namespace swf_vo::bench
