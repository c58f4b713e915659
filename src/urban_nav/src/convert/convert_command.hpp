// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"

namespace urban_nav {

/// Returns the command convert, which converts recordings and folders of public data sets to bags or MCAP.
Command convertCommand();

}  // namespace urban_nav
