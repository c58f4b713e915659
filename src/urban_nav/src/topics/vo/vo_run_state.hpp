// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "topics/vo/vo_run.hpp"

namespace urban_nav_core {
class Archive;
}

namespace urban_nav {

/// Read or write parts of a state (urban_nav_core/io/archive.hpp).
void archive(urban_nav_core::Archive& archive, VoPicture& picture);
void archive(urban_nav_core::Archive& archive, VoLandmark& landmark);

/// Returns a finished VoRun as the bytes of a stored state, exact to the last bit. Without the camera and the name
/// of the input, which are restored from the input.
std::string packVoRun(VoRun run);
/// Inverse of packVoRun, for the bytes of version 2 too. Returns nullopt for damaged bytes and for those of other
/// versions.
std::optional<VoRun> unpackVoRun(std::string_view bytes);

}  // namespace urban_nav
