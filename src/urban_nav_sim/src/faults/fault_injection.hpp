// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "urban_nav_sim/measurement.hpp"

namespace urban_nav_sim {

void setStamp(urban_nav_core::StampNs stamp, Measurement& measurement);
/// Left for right, where there are sides: of a stereo pair the images, of a laser whose turn it is. False where there
/// are none.
bool swapSides(Measurement& measurement);
/// CorruptedBytes in a share (0...1) of what was measured: rows of pictures, beams, numbers. Numbers stay finite.
void corrupt(double share, std::uint64_t seed, Measurement& measurement);
/// Draws bright streaks over a share of the pixels of a stereo pair; those of the two images differ, as drops are near.
void rain(double share, std::uint64_t seed, Measurement& measurement);
/// Makes a stereo pair darker by a factor (0...1), with the noise of the sensor.
void darken(double factor, std::uint64_t seed, Measurement& measurement);
/// Numbers become NaN, pictures black.
void blank(Measurement& measurement);

}  // namespace urban_nav_sim
