// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/stored_ids.hpp"

#include <algorithm>
#include <utility>

#include "store_implementation.hpp"
#include "tables/graph_tables.hpp"
#include "tables/session_tables.hpp"
#include "urban_nav_store/tables/stored_model.hpp"

namespace urban_nav_store {

namespace {

constexpr std::size_t kFewestDigits = 16, kMostDigits = 64;
constexpr std::size_t kShown = 80;  // of an id in an error

void checkColumn(Store::Implementation& store, const Table& table, const std::string& column) {
  if (!store.tables.has(table)) return;
  Statement statement = store.connection.prepare("SELECT DISTINCT " + column + " FROM " + table.name);
  while (statement.step()) {
    const std::string_view id = statement.text(0);
    if (!isStoredId(id))
      store.connection.damaged("in table " + table.name + ", " + column + " \"" + std::string(id.substr(0, kShown)) +
                               "\" does not consist of 16 to 64 hexadecimal digits");
  }
}

}  // namespace

bool isStoredId(std::string_view text) {
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return text.size() >= kFewestDigits && text.size() <= kMostDigits && std::all_of(text.begin(), text.end(), is_digit);
}

Store openForReading(const std::string& path, Access access) {
  Store store(path, access);
  Store::Implementation& parts = store.implementation();
  checkColumn(parts, declaredTable<SessionRow>(), "id");
  checkColumn(parts, declaredTable<AnchorRow>(), "map");
  checkColumn(parts, declaredTable<EdgeRow>(), "session_b");
  checkColumn(parts, declaredTable<StoredModel>(), "hash");
  return store;
}

}  // namespace urban_nav_store
