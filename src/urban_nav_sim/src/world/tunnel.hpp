// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace urban_nav_sim {

// The tunnel runs along x with its centre at y = 0 and its road at z = 0: vertical walls at y = +-kTunnelHalfWidth up
// to kTunnelSpring, above them a vault of that radius. Its geometry is constant along x except for ribs.
constexpr double kTunnelHalfWidth = 3.6, kTunnelSpring = 1.6;  ///< m
constexpr double kRibSpacing = 20.0;                           ///< m, of the world ribbed_tunnel

}  // namespace urban_nav_sim
