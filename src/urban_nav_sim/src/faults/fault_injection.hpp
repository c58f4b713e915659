// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "urban_nav_sim/measurement.hpp"

namespace urban_nav_sim {

void setStamp(urban_nav_core::StampNs stamp, Measurement& measurement);
/// Exchanges left and right: the images of a stereo pair, or the side of a laser scan. Returns false for sensors
/// without sides.
bool swapSides(Measurement& measurement);
/// Randomises a share (0...1) of the data: rows of images, beams, numbers. Numbers stay finite.
void corrupt(double share, std::uint64_t seed, Measurement& measurement);
/// Draws bright streaks over a share of the pixels of a stereo pair, different in both images, as for near drops.
void rain(double share, std::uint64_t seed, Measurement& measurement);
/// Darkens a stereo pair by a factor (0...1), with the noise of the sensor.
void darken(double factor, std::uint64_t seed, Measurement& measurement);
/// Sets numbers to NaN, and images to black.
void blank(Measurement& measurement);

}  // namespace urban_nav_sim
