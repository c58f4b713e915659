// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav {

/// Returns the version of the suite, that of package.xml: "0.1.0".
std::string suiteVersion();

}  // namespace urban_nav
