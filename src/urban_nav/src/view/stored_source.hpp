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
#include "view/map_points.hpp"
#include "view/map_source.hpp"
#include "view/page_events.hpp"

namespace urban_nav {

/// The map of a session store. Edits are made by editStore(), one at a time, and nothing is read meanwhile; a store
/// that another program writes is read and not changed.
class StoredSource final : public MapSource {
 public:
  using Values = std::map<std::string, std::vector<std::string>>;

  /// `options`: --config, --set and --threads, for edits that measure. `events` must outlive this object. Throws the
  /// errors of the store.
  StoredSource(const std::string& path, bool read_only, Values options, ParameterTables tables, PageEvents& events);

  std::string state() override;
  std::string paths() override;
  std::string points() override;
  Json explain(std::int64_t closure) override;
  Json explainMoment(const std::string& moment) override;
  std::optional<std::string> picture(std::int64_t closure, std::size_t number) override;
  Json edit(const EditWords& words) override;

  /// Notices changes that another program has committed. To be called about twice a second.
  void poll();

 private:
  struct Content;
  Content& content();
  const Page& explanation(std::int64_t closure);
  Arguments edgeArguments(const EditWords& words) const;
  template <typename Read>
  auto reading(const Read& read);

  const std::string path_;
  const bool read_only_;
  const Values options_;
  const ParameterTables tables_;
  PageEvents& events_;
  std::mutex mutex_;  ///< guards what follows, and the store: it is not read while it is edited
  std::shared_ptr<Content> content_;
  std::string seen_;    ///< size and time of the file and its log
  std::mutex loading_;  ///< guards what follows; taken before mutex_
  std::optional<MapPoints> points_;
};

/// Returns a page as JSON: what its elements show, without markup; pictures by their numbers, in order.
Json pageAsJson(const Page& page);

}  // namespace urban_nav
