// SPDX-License-Identifier: BSD-3-Clause
#include "map/stage_result.hpp"

namespace urban_nav {

std::string fileSuffix(std::size_t session) { return session == 0 ? "" : "_" + std::to_string(session + 1); }

}  // namespace urban_nav
