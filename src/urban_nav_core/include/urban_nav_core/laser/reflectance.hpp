// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace urban_nav_core {

/// Returns an echo of an LMS291 without the influence of range and incidence (0...255): near by, the optics of the
/// device lose light; far away it falls with the distance; matt surfaces follow Lambert's law. `range`: m; `cosine`: of
/// the angle between beam and normal; 1 where it is unknown.
float normaliseReflectance(float raw, float range, float cosine);

}  // namespace urban_nav_core
