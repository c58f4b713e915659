// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "topics/lo/lo_run.hpp"

namespace urban_nav {

/// Returns a LoRun as the bytes of a stored state, exact to the last bit, without the name of the input.
std::string packLoRun(LoRun run);
/// Inverse of packLoRun. Returns nullopt for damaged bytes and for those of other versions.
std::optional<LoRun> unpackLoRun(std::string_view bytes);

}  // namespace urban_nav
