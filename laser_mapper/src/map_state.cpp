// SPDX-License-Identifier: BSD-3-Clause
#include "map_state.hpp"

#include "urban_nav_core/io/archive.hpp"

namespace laser_mapper {
namespace {

constexpr std::uint32_t kMapStateVersion = 1;

void archiveMapState(urban_nav_core::Archive& archive, MapState& state) {
  Parameters& p = state.parameters;
  archive(p.voxel, p.min_range, p.max_range, p.range_sigma, p.range_bias, p.beam_width, p.mixed_pixels, p.max_gap,
          p.max_shift);
  archive(state.covariances);
}

}  // namespace

std::string packMapState(MapState state) {
  urban_nav_core::Archive archive;
  archiveMapState(archive, state);
  return urban_nav_core::seal(kMapState, kMapStateVersion, archive.take());
}

MapState unpackMapState(std::string_view bytes) {
  MapState state;
  urban_nav_core::Archive archive(urban_nav_core::unseal(kMapState, kMapStateVersion, bytes),
                                  std::string("state of ") + kMapState);
  archiveMapState(archive, state);
  archive.finish();
  return state;
}

}  // namespace laser_mapper
