// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace urban_nav_core {

/// Returns what a file of another kind than expected is, by its content and never by its name, as it reads after the
/// file's name: "is empty", "is a pointer of Git LFS, not the file itself", "is a vocabulary of ORB-SLAM2 (DBoW2)".
/// Empty for content that is not recognised. `content`: the beginning of the file, a few hundred bytes or more.
std::string describeForeignContent(std::string_view content);

}  // namespace urban_nav_core
