// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace urban_nav_input {

/// What lies at a path that is no input of the suite, and what makes an input of it.
struct ForeignInput {
  std::string found;   ///< follows the path in a sentence: "is compressed by gzip"
  std::string remedy;  ///< a command, or the input that was probably meant
};

/// Recognises stores of the suite, other databases, compressed bags, Git LFS pointers, empty files, and folders of
/// bags by their contents. Returns nullopt for anything else.
std::optional<ForeignInput> recogniseForeignInput(const std::string& path);

}  // namespace urban_nav_input
