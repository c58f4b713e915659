// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "convert/bag_writer.hpp"
#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav {

/// Writes a scan of the laser of a side ("left", "right") on its topic (docs/architecture.md). `id`: scan counter of
/// the device.
void writeLaser(const std::string& side, const urban_nav_core::PlanarScan& scan, std::uint32_t id, BagWriter& bag);

}  // namespace urban_nav
