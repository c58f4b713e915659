// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/command.hpp"
#include "base/page.hpp"
#include "topics/loops/stored_closure.hpp"
#include "urban_nav_store/store.hpp"
#include "view/compared_map.hpp"
#include "view/map_source.hpp"
#include "view/page_events.hpp"
#include "view/shown_tiles.hpp"

namespace urban_nav {

/// The map of a session store. Edits are applied by editStore(), one at a time, while the store is not read. A store
/// that is being written by another program is only read.
class StoredSource final : public MapSource {
 public:
  using Values = std::map<std::string, std::vector<std::string>>;

  /// `compared`: another store, which is read only, or nothing. `options`: --config, --set and --threads, for edits
  /// that measure. `events` must outlive this object. Throws the errors of the stores.
  StoredSource(const std::string& path, const std::string& compared, bool read_only, Values options,
               ParameterTables tables, PageEvents& events);

  std::string state() override;
  std::string paths() override;
  std::string comparedPlaces() override;
  Json tiles(const TileSelection& selection) override;
  std::optional<std::string> tile(std::size_t set, const laser_mapper::LevelTile& tile) override;
  std::string moves() override;
  Json explain(std::int64_t closure) override;
  Json explainMoment(const std::string& moment) override;
  std::optional<std::string> view(std::size_t session, double seconds) override;
  Json tryMeasurement(const std::string& t1, const std::string& t2) override;
  std::optional<std::string> picture(std::int64_t closure, std::size_t number) override;
  Json edit(const EditWords& words) override;

  /// Detects changes committed by another program. Call about twice a second.
  void poll();

 private:
  struct Content;
  Content& content();
  const Page& explanation(std::int64_t closure);
  double cloudHalfLength() const;
  std::string filesState() const;
  std::shared_ptr<ShownTiles> shownTiles();
  Arguments edgeArguments(const EditWords& words) const;
  template <typename Read>
  auto reading(const Read& read);

  const std::string path_, compared_path_;
  const bool read_only_;
  const Values options_;
  const ParameterTables tables_;
  PageEvents& events_;
  std::mutex mutex_;  ///< guards the following members and the store
  std::shared_ptr<Content> content_;
  std::optional<ComparedMap> compared_;
  std::string seen_;    ///< size and time of the files and their logs
  std::mutex loading_;  ///< guards the following members; locked before mutex_
  std::shared_ptr<ShownTiles> tiles_;
};

/// Returns the content of a page as JSON, without markup; pictures by their numbers, in order.
Json pageAsJson(const Page& page);

}  // namespace urban_nav
