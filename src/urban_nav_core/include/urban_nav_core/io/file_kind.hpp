// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace urban_nav_core {

/// Returns a description of a file that is not of the expected kind, by its content and not its name, to follow the
/// file's name: "is empty", "is a pointer of Git LFS, not the file itself", "is a vocabulary of ORB-SLAM2 (DBoW2)".
/// Empty for unknown content. `content`: the beginning of the file, a few hundred bytes or more.
std::string describeForeignContent(std::string_view content);

}  // namespace urban_nav_core
