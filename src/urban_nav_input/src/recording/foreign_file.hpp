// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace urban_nav_input {

/// Kind of a file that is not a recording, and a remedy.
struct ForeignInput {
  std::string found;   ///< follows the path in a sentence: "is compressed by gzip"
  std::string remedy;  ///< a command, or the probably intended input
};

/// Recognises stores of the suite, other databases, compressed bags, Git LFS pointers and empty files by their content.
/// Returns nullopt for other files. Requires a regular file that is not a recording.
std::optional<ForeignInput> recogniseForeignFile(const std::string& path);

}  // namespace urban_nav_input
