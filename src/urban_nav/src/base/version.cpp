// SPDX-License-Identifier: BSD-3-Clause
#include "base/version.hpp"

namespace urban_nav {

std::string suiteVersion() { return URBAN_NAV_VERSION; }

}  // namespace urban_nav
