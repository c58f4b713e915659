// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "manifold/rotation.hpp"
#include "pose_graph/problem.hpp"

namespace pose_graph::test {

/// Returns a closed ring of equal, exactly measured steps, with initial poses that make `rounds` full turns.
inline Problem<2> ring(int poses, int rounds) {
  Problem<2> made;
  Edge<2> step;
  step.Z.R = expRotation(RotationVector<2>(2.0 * M_PI / poses));
  step.Z.t = {1.0, 0.0};
  Rigid<2> T;
  for (int i = 0; i < poses; ++i) {
    made.poses.push_back(T);
    T.t += T.R.col(0);
    T.R = expRotation(RotationVector<2>(2.0 * M_PI * rounds * (i + 1) / poses));
    step.from = i;
    step.to = (i + 1) % poses;
    made.edges.push_back(step);
  }
  return made;
}

}  // namespace pose_graph::test
