// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "stages/vo/vo_stage.hpp"

namespace urban_nav {

/// All that a finished VoRun holds but its camera, which comes with the input: bit by bit, so that files made of it afterwards
/// have the bytes of a run that was not cut off.
std::string packVoRun(const VoRun& run);
/// Empty where the bytes are no such thing.
std::optional<VoRun> unpackVoRun(std::string_view bytes);

}  // namespace urban_nav
