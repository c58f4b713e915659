// SPDX-License-Identifier: BSD-3-Clause
#include "base/web_files.hpp"

namespace urban_nav {

std::string webFiles(std::initializer_list<const char*> names) {
  std::string text;
  for (const char* name : names) text += webFile(name);
  return text;
}

}  // namespace urban_nav
