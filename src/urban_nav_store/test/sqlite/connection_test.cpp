// SPDX-License-Identifier: BSD-3-Clause
#include "sqlite/connection.hpp"

#include <gtest/gtest.h>

#include "support/folder.hpp"

namespace urban_nav_store {
namespace {

using testing::expectError;
using testing::Folder;

TEST(Connection, KeepsValuesExactly) {
  const Folder folder;
  Connection connection(folder.file("c.db"), Connection::Mode::Create, "shown.db");
  connection.execute("CREATE TABLE t(a INTEGER, b REAL, c TEXT, d BLOB)");
  const std::string text("zero \0 within", 13), empty;
  {
    Statement put = connection.prepare("INSERT INTO t VALUES(?,?,?,?)");
    put.bind(0, std::int64_t{-9223372036854775807});
    put.bind(1, 0.1);
    put.bind(2, std::string_view(text));
    put.bindBlob(3, empty);
    EXPECT_FALSE(put.step());
  }
  Statement get = connection.prepare("SELECT * FROM t");
  ASSERT_TRUE(get.step());
  EXPECT_EQ(get.integer(0), -9223372036854775807);
  EXPECT_EQ(get.real(1), 0.1);
  EXPECT_EQ(get.text(2), text);
  EXPECT_EQ(get.blob(3), "");
  expectError([&] { get.text(3); }, "shown.db", "column d holds another type");
  expectError([&] { get.integer(1); }, "shown.db", "column b holds another type");
  EXPECT_FALSE(get.step());
}

TEST(Connection, AnErrorTakesBackTheTransaction) {
  const Folder folder;
  Connection connection(folder.file("c.db"), Connection::Mode::Create);
  connection.execute("CREATE TABLE t(a NOT NULL)");
  connection.beginWriting();
  connection.execute("INSERT INTO t VALUES(1)");
  expectError([&] { connection.execute("INSERT INTO t VALUES(NULL)"); }, connection.name(), "NOT NULL");
  EXPECT_FALSE(connection.inTransaction());
  EXPECT_EQ(connection.integer("SELECT count(*) FROM t"), 0);
}

TEST(Connection, ClosedIsClosed) {
  const Folder folder;
  Connection connection(folder.file("c.db"), Connection::Mode::Create);
  connection.execute("CREATE TABLE t(a)");
  Statement& cached = connection.cached("SELECT a FROM t");
  EXPECT_FALSE(cached.step());
  Statement own = connection.prepare("SELECT a FROM t");
  connection.close();
  expectError([&] { own.step(); }, connection.name(), "is closed");
  expectError([&] { connection.cached("SELECT a FROM t"); }, connection.name(), "is closed");
  expectError([&] { connection.execute("SELECT 1"); }, connection.name(), "is closed");
}

}  // namespace
}  // namespace urban_nav_store
