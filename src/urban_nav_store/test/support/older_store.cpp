// SPDX-License-Identifier: BSD-3-Clause
#include "support/older_store.hpp"

#include "schema/schema.hpp"
#include "sqlite/connection.hpp"

namespace urban_nav_store::testing {

namespace {

std::string createStatement(Connection& connection, const std::string& table) {
  Statement statement = connection.prepare("SELECT sql FROM sqlite_master WHERE name=?");
  statement.bind(0, table);
  return statement.step() ? std::string(statement.text(0)) : "";
}

}  // namespace

void makeOlder(const std::string& path, const Folder& folder, int version) {
  Connection pattern(folder.file("pattern.db"), Connection::Mode::Create);
  schema::create(pattern, schema::tables(), version);
  Connection store(path, Connection::Mode::Write);
  for (const Table* table : schema::tables()) {
    const std::string& name = table->name;
    if (createStatement(pattern, name) == createStatement(store, name)) continue;
    store.execute("DROP TABLE " + name + "; DELETE FROM tally WHERE name='" + name + "'");
    Statement parts = pattern.prepare("SELECT sql FROM sqlite_master WHERE sql IS NOT NULL AND tbl_name='" + name +
                                      "' ORDER BY type='trigger'");
    while (parts.step()) store.execute(std::string(parts.text(0)));
  }
  store.execute("PRAGMA user_version=" + std::to_string(version));
}

}  // namespace urban_nav_store::testing
