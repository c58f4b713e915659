// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/interpolate.hpp"

namespace urban_nav_core {

Pose interpolate(const Pose& a, const Pose& b, double share) {
  if (share == 0.0) return a;
  if (share == 1.0) return b;
  const Vector3d turn = logSo3(b.q() * a.q().conjugate());
  return Pose(expSo3(share * turn) * a.q(), a.t() + share * (b.t() - a.t()));
}

}  // namespace urban_nav_core
