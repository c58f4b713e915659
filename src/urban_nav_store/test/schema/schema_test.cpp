// SPDX-License-Identifier: BSD-3-Clause
#include "schema/schema.hpp"

#include <gtest/gtest.h>

#include "support/folder.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::expectError;
using testing::Folder;

TEST(Schema, isThatOfItsVersion) {
  const Folder folder;
  Connection connection(folder.file("s.db"), Connection::Mode::Create);
  schema::create(connection);
  EXPECT_NO_THROW(schema::check(connection));
  EXPECT_EQ(schema::migrationSteps().size(), static_cast<std::size_t>(kSchemaVersion));
}

TEST(Schema, migratesStepByStepOrNotAtAll) {
  const Folder folder;
  Connection connection(folder.file("s.db"), Connection::Mode::Create);
  connection.execute("CREATE TABLE t(a); PRAGMA user_version=1");
  const std::vector<std::string> steps = {"this is never run", "ALTER TABLE t ADD COLUMN b",
                                          "ALTER TABLE t ADD COLUMN c"};
  expectError(
      [&] {
        schema::migrate(connection, {steps[0], steps[1], "ALTER TABLE nothing ADD COLUMN c"});
      },
      connection.name(), "SQLite says");
  EXPECT_EQ(connection.integer("PRAGMA user_version"), 1);
  schema::migrate(connection, steps);
  EXPECT_EQ(connection.integer("PRAGMA user_version"), 3);
  EXPECT_NO_THROW(connection.execute("SELECT a, b, c FROM t"));
  schema::migrate(connection, steps);
  EXPECT_EQ(connection.integer("PRAGMA user_version"), 3) << "nothing is left to do";
}

TEST(Schema, aTableThatWasChangedByHandIsNamed) {
  const Folder folder;
  for (const char* change : {"DROP TRIGGER node_in", "DROP TABLE scan", "ALTER TABLE edge ADD COLUMN more"}) {
    Connection connection(folder.file(std::string(change) + ".db"), Connection::Mode::Create);
    schema::create(connection);
    connection.execute(change);
    expectError([&] { schema::check(connection); }, connection.name(), "is not as it was made");
  }
}

}  // namespace
}  // namespace urban_nav_store
