// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace urban_nav {

/// The page's CSS, and the script that reads values off a plot under the pointer. Both are part of the file: nothing is
/// fetched.
const char* pageStyle();
const char* pageScript();

}  // namespace urban_nav
