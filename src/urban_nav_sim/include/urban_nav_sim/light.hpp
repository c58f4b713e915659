// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_sim {

/// Time of day of a session: the sun of the day (`SessionOptions::day`), a sun 3 deg above the horizon, or no sun.
enum class Light { Day, Dusk, Night };

const char* toString(Light light);
/// Returns the words of parseLight(), separated by commas.
std::string lightList();
/// Parses `day`, `dusk` or `night`. Throws UserError that lists them; `where`: the option.
Light parseLight(const std::string& word, const std::string& where = "--light");

}  // namespace urban_nav_sim
