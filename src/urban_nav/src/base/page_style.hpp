// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace urban_nav {

/// CSS of the page, and the script that shows the values of a plot under the pointer. Both are embedded in the page.
const char* pageStyle();
const char* pageScript();

}  // namespace urban_nav
