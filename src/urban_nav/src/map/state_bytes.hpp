// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav {

/// Returns the state of an object for SessionPass::checkpoint() and SessionPass::finished(). `State` has a member
/// function archive(urban_nav_core::Archive&). Increase `version` when its members change.
template <typename State>
std::string packState(const std::string& name, std::uint32_t version, State& state) {
  urban_nav_core::Archive archive;
  archive(state);
  return urban_nav_core::seal(name, version, archive.take());
}

/// Restores an object from the output of packState(). Throws DataError naming the state if the bytes are damaged or of
/// another version.
template <typename State>
void unpackState(const std::string& name, std::uint32_t version, std::string_view bytes, State& state) {
  urban_nav_core::Archive archive(urban_nav_core::unseal(name, version, bytes), "state of " + name);
  archive(state);
  archive.finish();
}

}  // namespace urban_nav
