// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace urban_nav_core {

/// Returns the intensity of an LMS291 echo (0...255) corrected for range and incidence angle: the optics lose light at
/// short range, intensity falls with distance at long range, matt surfaces follow Lambert's law. `range`: m. `cosine`:
/// of the angle between beam and normal; 1 if unknown.
float normaliseReflectance(float raw, float range, float cosine);

}  // namespace urban_nav_core
