// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "recording/foreign_file.hpp"

namespace urban_nav_input {

/// Recognises stores of the suite, other databases, compressed bags, Git LFS pointers, empty files, and folders of
/// bags by their contents. Returns nullopt for other inputs.
std::optional<ForeignInput> recogniseForeignInput(const std::string& path);

}  // namespace urban_nav_input
