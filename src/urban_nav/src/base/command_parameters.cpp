// SPDX-License-Identifier: BSD-3-Clause
#include "base/command_parameters.hpp"

namespace urban_nav {

CommandParameters::CommandParameters() { commandTable().setDefaults(*this); }

const urban_nav_core::Table<CommandParameters>& commandTable() {
  static const urban_nav_core::Table<CommandParameters> table(
      "", {{"memory_mb",
            &CommandParameters::memory_mb,
            "MB",
            4000,
            200,
            10000000,
            {},
            "Bounds the memory for reading ahead and for decompressed files; without effect on the results.",
            ""}});
  return table;
}

}  // namespace urban_nav
