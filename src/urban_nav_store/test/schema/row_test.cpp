// SPDX-License-Identifier: BSD-3-Clause
#include "schema/row.hpp"

#include <gtest/gtest.h>

#include "schema/table_access.hpp"
#include "support/contents.hpp"
#include "support/folder.hpp"
#include "tables/graph_tables.hpp"

namespace urban_nav_store {
namespace {

using testing::Drawn;
using testing::expectError;
using testing::Folder;

class Rows : public ::testing::Test {
 protected:
  Rows() : connection(folder.file("s.db"), Connection::Mode::Create) {
    schema::create(connection);
    Drawn drawn(1);
    for (int i = 0; i < 5; ++i) put("one", i, drawn);
    put("two", 0, drawn);
    connection.commit();
  }
  void put(const std::string& session, int stamp, Drawn& drawn) {
    TableAccess(connection).put(table, unchanged(NodeRow{session, drawn.node(stamp)}));
  }
  void readAll(const std::string& session) {
    RowReader reader(connection, table, "WHERE session=?");
    reader.statement().bind(0, session);
    while (reader.next()) readRow(reader);
    verifyTally(reader, session);
    verifyTally(connection, table, session);
  }

  const Folder folder;
  Connection connection;
  const Table& table = declaredTable<NodeRow>();
};

TEST_F(Rows, AddUp) {
  EXPECT_NO_THROW(readAll("one"));
  EXPECT_NO_THROW(readAll("two"));
  EXPECT_NO_THROW(readAll("none"));
  Drawn drawn(2);
  put("one", 3, drawn);  // replaced
  put("one", 9, drawn);
  EXPECT_NO_THROW(readAll("one"));
  connection.execute("DELETE FROM node WHERE stamp_ns=2");
  EXPECT_NO_THROW(readAll("one"));
}

TEST_F(Rows, AChangeOfAnyColumnIsDetected) {
  for (const Column& column : table.columns) {
    connection.beginWriting();
    const std::string other = column.type == ColumnType::Text      ? "'one ' || stamp_ns"
                              : column.type == ColumnType::Integer ? "stamp_ns+100"
                              : column.type == ColumnType::Real    ? column.name + "+1e-9"
                                                                   : "zeroblob(288)";
    connection.execute("UPDATE node SET " + column.name + "=" + other + " WHERE session='one' AND stamp_ns=3");
    RowReader reader(connection, table, "");
    expectError(
        [&] {
          while (reader.next()) readRow(reader);
        },
        connection.name(), "is damaged: in table node");
    connection.rollback();
  }
}

TEST_F(Rows, AnotherTypeIsDetected) {
  connection.execute("UPDATE node SET covariance='text' WHERE stamp_ns=3");
  expectError([&] { readAll("one"); }, connection.name(), "holds another type");
}

TEST_F(Rows, ARowThatIsGoneIsMissed) {
  connection.execute("UPDATE tally SET count=count+1 WHERE session='one'");
  expectError([&] { readAll("one"); }, connection.name(), "do not match the 6 written");
  connection.execute("UPDATE tally SET count=count-1, sum=sum+1 WHERE session='one'");
  expectError([&] { readAll("one"); }, connection.name(), "do not match");
  connection.execute("DELETE FROM tally");
  expectError([&] { readAll("one"); }, connection.name(), "do not match");
}

TEST(RowChecksum, BytesDoNotMoveBetweenColumns) {
  RowChecksum one, two, blob;
  one.text("ab"), one.text("c");
  two.text("a"), two.text("bc");
  blob.blob("ab"), blob.text("c");
  EXPECT_NE(one.value(), two.value());
  EXPECT_NE(one.value(), blob.value());
}

}  // namespace
}  // namespace urban_nav_store
