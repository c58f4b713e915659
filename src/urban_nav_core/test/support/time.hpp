// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

constexpr StampNs kMillisecond = 1'000'000, kSecond = 1'000'000'000;

}  // namespace urban_nav_core
