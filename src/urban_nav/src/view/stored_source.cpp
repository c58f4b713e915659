// SPDX-License-Identifier: BSD-3-Clause
#include "view/stored_source.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>

#include "base/command_parameters.hpp"
#include "base/parameters.hpp"
#include "edits/edge_list.hpp"
#include "edits/edit_measurement.hpp"
#include "edits/edit_store.hpp"
#include "edits/edited_map.hpp"
#include "edits/jump.hpp"
#include "topics/loops/explanation.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/parameters.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/store_writer.hpp"
#include "urban_nav_store/stored_ids.hpp"
#include "urban_nav_store/stored_map.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_test.hpp"
#include "view/state_json.hpp"

namespace urban_nav {

using urban_nav_core::UserError;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

constexpr double kTileImageShare = 0.1;        // share of memory_mb for decoded images
constexpr std::size_t kKeptExplanations = 20;  // with their pictures, about 0.1 MB each

constexpr std::int64_t kTried = 0;  // closures of a store have IDs from 1

constexpr double kLargestViewGap = 2.0;  // s

/// Returns the view of the left camera nearest to a time as JPEG.
std::optional<std::string> nearestView(Store& store, const urban_nav_store::SessionId& session,
                                       urban_nav_core::StampNs stamp) {
  const std::optional<urban_nav_core::StampNs> nearest = findNearestView(store, {session, stamp}, kLargestViewGap);
  if (!nearest) return std::nullopt;
  const auto row = store.keyframes().get(session, urban_nav_registration::kKeyframeCamera, *nearest);
  const urban_nav_registration::Keyframe keyframe = urban_nav_registration::toKeyframe(*row, session);
  if (keyframe.image.empty()) return std::nullopt;
  return std::string(keyframe.image.begin(), keyframe.image.end());
}

/// Returns a text that changes when a file or its log is written.
std::string fileState(const std::string& path) {
  std::string text;
  for (const char* suffix : {"", "-wal"}) {
    struct stat file {};
    if (::stat((path + suffix).c_str(), &file) != 0) continue;
    text += std::to_string(file.st_ino) + " " + std::to_string(file.st_size) + " " +
            std::to_string(file.st_mtim.tv_sec) + "." + std::to_string(file.st_mtim.tv_nsec) + ";";
  }
  return text;
}

}  // namespace

/// A store open for reading, and its content.
struct StoredSource::Content {
  explicit Content(const std::string& path) : store(urban_nav_store::openForReading(path)) {
    for (const auto& map : readMaps(store, urban_nav_store::selectSessions(store, {}))) maps.push_back(map);
    closures = listEditableClosures(store);
    edits = listEdits(store);
    for (const auto& map : maps)
      for (const StoredTrajectory& each : map)
        urban_nav_store::TableStore<urban_nav_store::StoredTest>(store).forEach(
            each.session.id, [this](const urban_nav_store::StoredTest& test) { tests.push_back(test); });
  }

  Store store;
  std::vector<std::vector<StoredTrajectory>> maps;
  std::vector<StoredClosure> closures;
  std::vector<ListedEdit> edits;
  std::vector<urban_nav_store::StoredTest> tests;
  std::map<std::int64_t, Page> explanations;
};

StoredSource::StoredSource(const std::string& path, const std::string& compared, bool read_only, Values options,
                           ParameterTables tables, PageEvents& events)
    : path_(path),
      compared_path_(compared),
      read_only_(read_only),
      options_(std::move(options)),
      tables_(std::move(tables)),
      events_(events) {
  const std::lock_guard lock(mutex_);
  content();
}

std::string StoredSource::filesState() const {
  return fileState(path_) + (compared_path_.empty() ? "" : "|" + fileState(compared_path_));
}

StoredSource::Content& StoredSource::content() {
  if (!content_) {
    seen_ = filesState();
    content_ = std::make_shared<Content>(path_);
    if (!compared_path_.empty()) compared_.emplace(compared_path_);
  }
  return *content_;
}

/// Calls a function with the content; again if another program has written the store meanwhile.
template <typename Read>
auto StoredSource::reading(const Read& read) {
  const std::lock_guard lock(mutex_);
  try {
    return read(content());
  } catch (const urban_nav_core::DataError&) {
    if (filesState() == seen_) throw;
    content_.reset();
    return read(content());
  }
}

std::string StoredSource::state() {
  return reading([&](const Content& content) {
    ShownState shown{content.maps, content.closures, content.edits, content.tests};
    shown.store = path_;
    shown.revision = events_.state().revision;
    shown.read_only = read_only_;
    shown.written_by_another = urban_nav_store::isBeingWritten(path_);
    Json json = stateAsJson(shown);
    if (compared_) json["compared"] = compared_->summary(content.maps);
    return json.print();
  });
}

std::string StoredSource::comparedPlaces() {
  return reading([&](const Content& content) { return compared_ ? compared_->place(content.maps) : std::string(); });
}

std::string StoredSource::paths() {
  return reading([](const Content& content) {
    std::string bytes;
    for (const std::vector<StoredTrajectory>& map : content.maps)
      for (const StoredTrajectory& each : map) appendPath(bytes, each.T_map_base);
    return bytes;
  });
}

std::shared_ptr<ShownTiles> StoredSource::shownTiles() {
  const std::lock_guard lock(loading_);
  if (!tiles_) {
    const ShownTiles::Maps maps = reading([](const Content& content) { return content.maps; });
    const double memory_mb =
        kTileImageShare * loadParameters(Arguments(options_, tables_)).get(commandTable()).memory_mb;
    Store store = urban_nav_store::openForReading(path_);  // a separate handle, since computing tiles may take minutes
    tiles_ = std::make_shared<ShownTiles>(store, maps, memory_mb);
  }
  return tiles_;
}

Json StoredSource::tiles(const TileSelection& selection) { return shownTiles()->list(selection); }

std::optional<std::string> StoredSource::tile(std::size_t set, const laser_mapper::LevelTile& tile) {
  const std::shared_ptr<ShownTiles> shown = shownTiles();
  return reading([&](Content& content) { return shown->tile(content.store, set, tile); });
}

std::string StoredSource::moves() {
  const std::shared_ptr<ShownTiles> shown = shownTiles();
  return shown->moves(reading([](const Content& content) { return content.maps; }));
}

Json StoredSource::explainMoment(const std::string& moment) {
  Store store = urban_nav_store::openForReading(path_);
  return pageAsJson(explainOnPage(explainJump(store, moment), path_));
}

const Page& StoredSource::explanation(std::int64_t closure) {
  Content& its = content();
  if (const auto known = its.explanations.find(closure); known != its.explanations.end()) return known->second;
  const auto found = std::find_if(its.closures.begin(), its.closures.end(),
                                  [&](const StoredClosure& each) { return each.id == closure; });
  if (found == its.closures.end())
    throw UserError("closure", std::to_string(closure) + ": no such closure", "an ID of the list");
  if (its.explanations.size() >= kKeptExplanations) its.explanations.clear();
  return its.explanations[closure] = explainOnPage(*found, its.store, cloudHalfLength());
}

double StoredSource::cloudHalfLength() const {
  return loadParameters(Arguments(options_, tables_)).get(urban_nav_registration::table()).cloud_half_length;
}

Json StoredSource::explain(std::int64_t closure) {
  return reading([&](Content&) { return pageAsJson(explanation(closure)); });
}

std::optional<std::string> StoredSource::view(std::size_t session, double seconds) {
  return reading([&](Content& content) -> std::optional<std::string> {
    std::size_t place = session;
    for (const std::vector<StoredTrajectory>& map : content.maps) {
      if (place >= map.size()) {
        place -= map.size();
        continue;
      }
      const StoredTrajectory& shown = map[place];
      if (shown.T_map_base.empty()) return std::nullopt;
      return nearestView(content.store, shown.session.id, shown.T_map_base.front().stamp + std::llround(1e9 * seconds));
    }
    throw UserError("session", std::to_string(session) + ": no such session", "an index in the list of sessions");
  });
}

Json StoredSource::tryMeasurement(const std::string& t1, const std::string& t2) {
  const std::lock_guard lock(mutex_);
  Content& its = content();
  Store store = urban_nav_store::openForReading(path_, urban_nav_store::Access::Snapshot);
  EditWords words;
  words.action = "measure";
  words.arguments = {t1, t2};
  const EditRequest request = readEditRequest(edgeArguments(words), store, readMeasurements(store));
  const StoredClosure measured = describeEdge(store, request.edit.edge, request.edit.evidence);
  Page& page = its.explanations[kTried] = explainOnPage(measured, store, cloudHalfLength());
  Json json = pageAsJson(page);
  json["accepted"] = request.unchanged.empty();
  json["reason"] = request.unchanged;
  return json;
}

std::optional<std::string> StoredSource::picture(std::int64_t closure, std::size_t number) {
  return reading([&](Content&) -> std::optional<std::string> {
    for (const Section& section : explanation(closure).sections)
      for (const PagePicture& each : section.pictures)
        if (number-- == 0) return std::string(each.jpeg.begin(), each.jpeg.end());
    return std::nullopt;
  });
}

Arguments StoredSource::edgeArguments(const EditWords& words) const {
  Values values = options_;
  values["STORE"] = {path_};
  values["ACTION"] = {words.action};
  if (!words.arguments.empty()) values["ARGUMENT"] = words.arguments;
  for (const auto& [name, value] : words.options) values[name] = {value};
  return Arguments(std::move(values), tables_);
}

Json StoredSource::edit(const EditWords& words) {
  if (read_only_) throw UserError("urban_nav view", "an edit of a store that is shown by --read-only", "no edits");
  const std::lock_guard lock(mutex_);
  events_.begin(words.print());
  content_.reset();  // the edit needs exclusive access, and removes the log at the end
  try {
    const EditResult result = editStore(edgeArguments(words));
    Json json = toJson(result.outcome);
    const std::string text = describe(result);
    json["text"] = text;
    seen_ = filesState();
    events_.finish(text, result.outcome.changed);
    return json;
  } catch (const std::exception& error) {
    events_.finish(error.what(), false);
    throw;
  }
}

void StoredSource::poll() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  std::string now = filesState();
  if (now == seen_) return;
  seen_ = std::move(now);
  content_.reset();
  events_.changed();
  const std::unique_lock loading(loading_, std::try_to_lock);
  if (loading) tiles_.reset();
}

Json pageAsJson(const Page& page) {
  Json json = Json::object({{"title", page.title}, {"subtitle", page.subtitle}});
  Json& verdicts = json["verdicts"] = Json::array();
  for (const Verdict& verdict : page.verdicts)
    verdicts.append(Json::object({{"headline", verdict.headline}, {"sentence", verdict.sentence}}));
  Json& tiles = json["tiles"] = Json::array();
  for (const Tile& tile : page.tiles) tiles.append(tile.label + ": " + tile.value + " " + tile.unit);
  Json& sections = json["sections"] = Json::array();
  std::size_t pictures = 0;
  for (const Section& section : page.sections) {
    Json one = Json::object({{"title", section.title}, {"introduction", section.introduction}});
    Json& drawn = one["pictures"] = Json::array();
    for (const PagePicture& picture : section.pictures)
      drawn.append(Json::object({{"number", pictures++},
                                 {"caption", picture.caption},
                                 {"width", picture.width},
                                 {"height", picture.height}}));
    Json& tables = one["tables"] = Json::array();
    for (const PageTable& table : section.tables) {
      Json its = Json::object({{"title", table.title}, {"caption", table.caption}});
      Json& head = its["head"] = Json::array();
      for (const std::string& cell : table.head) head.append(cell);
      Json& rows = its["rows"] = Json::array();
      for (const std::vector<std::string>& row : table.rows) {
        Json cells = Json::array();
        for (const std::string& cell : row) cells.append(cell);
        rows.append(std::move(cells));
      }
      tables.append(std::move(its));
    }
    sections.append(std::move(one));
  }
  return json;
}

}  // namespace urban_nav
