// SPDX-License-Identifier: BSD-3-Clause
#include "schema/schema.hpp"

#include <gtest/gtest.h>

#include "support/folder.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::expectError;
using testing::Folder;

TEST(Schema, IsThatOfItsVersion) {
  const Folder folder;
  Connection connection(folder.file("s.db"), Connection::Mode::Create);
  schema::create(connection);
  EXPECT_NO_THROW(schema::check(connection));
  EXPECT_EQ(schema::version(connection), schemaVersion());
}

TEST(Schema, ATableThatWasChangedByHandIsNamed) {
  const Folder folder;
  for (const char* change : {"DROP TRIGGER node_in", "DROP TABLE scan", "ALTER TABLE edge ADD COLUMN more"}) {
    Connection connection(folder.file(std::string(change) + ".db"), Connection::Mode::Create);
    schema::create(connection);
    connection.execute(change);
    expectError([&] { schema::check(connection); }, connection.name(), "has a different schema");
  }
}

}  // namespace
}  // namespace urban_nav_store
