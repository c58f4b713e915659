// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "convert/bag_writer.hpp"
#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav {

/// A turn of the laser of that side ("left", "right") on the topic of docs/architecture.md. `id`: counts the device's
/// turns.
void writeLaser(const std::string& side, const urban_nav_core::PlanarScan& scan, std::uint32_t id, BagWriter& bag);

}  // namespace urban_nav
