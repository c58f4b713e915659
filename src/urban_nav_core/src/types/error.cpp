// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/error.hpp"

#include <utility>

namespace urban_nav_core {
namespace {

std::string join(const Error::Parts& parts) {
  std::string text;
  const auto append = [&text](const std::string& part, const char* before) {
    if (part.empty()) return;
    if (!text.empty()) text += ": ";
    text += before + part;
  };
  append(parts.where, "");
  append(parts.found, "");
  const bool has_own_word = parts.allowed.rfind("allowed ", 0) == 0;
  append(parts.allowed, has_own_word ? "" : "expected ");
  return text;
}

}  // namespace

Error::Error(Parts parts) : std::runtime_error(join(parts)), parts_(std::move(parts)) {}

Error::Error(std::string where, std::string found, std::string allowed)
    : Error(Parts{std::move(where), std::move(found), std::move(allowed)}) {}

UserError::UserError(Parts parts) : Error(std::move(parts)) {}

UserError::UserError(std::string where, std::string found, std::string allowed)
    : Error(std::move(where), std::move(found), std::move(allowed)) {}

DataError::DataError(Parts parts) : Error(std::move(parts)) {}

DataError::DataError(std::string where, std::string found, std::string allowed)
    : Error(std::move(where), std::move(found), std::move(allowed)) {}

std::string atLine(const std::string& path, int line) { return line > 0 ? path + ":" + std::to_string(line) : path; }

}  // namespace urban_nav_core
