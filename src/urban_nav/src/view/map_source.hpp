// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "base/json.hpp"
#include "view/edit_words.hpp"
#include "view/shown_tiles.hpp"

namespace urban_nav {

/// A map shown and edited by the page: in a store, or in nodelets that build it. Implementations are thread-safe;
/// functions throw UserError for errors of the user and DataError for unsuitable data.
class MapSource {
 public:
  MapSource() = default;
  MapSource(const MapSource&) = delete;
  MapSource& operator=(const MapSource&) = delete;
  virtual ~MapSource() = default;

  /// Returns sessions, closures and edits.
  virtual std::string state() = 0;
  /// Returns the poses of all sessions in the order of state(): for each one seconds since its beginning, x, y, z (m,
  /// in its map) as float32 in little endian.
  virtual std::string paths() = 0;
  /// Returns the positions of the poses of paths() in another map, in the encoding of ComparedMap; empty without one.
  virtual std::string comparedPlaces() = 0;
  /// Returns the tiles of the points of the maps, as ShownTiles::list(), without sets if there are no points.
  virtual Json tiles(const TileSelection& selection) = 0;
  /// Returns the points of a tile, as ShownTiles::tile(); nullopt if there is no such tile.
  virtual std::optional<std::string> tile(std::size_t set, const laser_mapper::LevelTile& tile) = 0;
  /// Returns the motion of the poses since the points were rendered, as ShownTiles::moves().
  virtual std::string moves() = 0;
  /// Returns the closures that determine the pose at a moment, given as for `why --jump`.
  virtual Json explainMoment(const std::string& moment) = 0;
  /// Returns the explanation of the verdict on a closure.
  virtual Json explain(std::int64_t closure) = 0;
  /// Returns the stored view of the left camera nearest to a moment, `seconds` since the beginning of a session in the
  /// order of state(), as JPEG; nullopt without one within 2 s.
  virtual std::optional<std::string> view(std::size_t session, double seconds) = 0;
  /// Measures the transform between two moments, given as for `edge`, without changing the map. Returns the keys of
  /// explain(), `accepted`, and `reason` if it is not; its pictures are those of closure 0 until the next call.
  virtual Json tryMeasurement(const std::string& t1, const std::string& t2) = 0;
  /// Returns the picture of a registration attempt of a closure as JPEG; nullopt without one.
  virtual std::optional<std::string> picture(std::int64_t closure, std::size_t number) = 0;
  /// Applies an edit and returns its effect: the keys of `urban_nav edge --json`, and `text`.
  virtual Json edit(const EditWords& words) = 0;
};

}  // namespace urban_nav
