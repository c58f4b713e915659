// SPDX-License-Identifier: BSD-3-Clause
// Files of schema 2, created by the SQL of the programs of that time, and later schemas derived from declarations.
#include <gtest/gtest.h>

#include "schema/row.hpp"
#include "schema/schema.hpp"
#include "schema/table_access.hpp"
#include "support/contents.hpp"
#include "support/folder.hpp"
#include "tables/session_tables.hpp"
#include "urban_nav_store/dump.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::expectError;
using testing::Folder;

struct TableOfVersion2 {
  std::string name;
  bool is_narrow;
  std::string keys, columns;
};

const std::vector<TableOfVersion2> kVersion2 = {
    {"session", true, "id", "id TEXT,name TEXT,robot TEXT,recording TEXT,start_ns INTEGER,complete INTEGER"},
    {"anchor", true, "session",
     "session TEXT,map TEXT,revision INTEGER,x REAL,y REAL,z REAL,qx REAL,qy REAL,qz REAL,qw REAL"},
    {"parameter", true, "session,name", "session TEXT,name TEXT,value TEXT,origin TEXT"},
    {"property", true, "session,name", "session TEXT,name TEXT,value TEXT"},
    {"extrinsic", true, "session,frame",
     "session TEXT,frame TEXT,x REAL,y REAL,z REAL,qx REAL,qy REAL,qz REAL,qw REAL"},
    {"node", true, "session,stamp_ns",
     "session TEXT,stamp_ns INTEGER,x REAL,y REAL,z REAL,qx REAL,qy REAL,qz REAL,qw REAL,status TEXT,"
     "covariance BLOB,drift BLOB"},
    {"relaxed", true, "session,stamp_ns",
     "session TEXT,stamp_ns INTEGER,x REAL,y REAL,z REAL,qx REAL,qy REAL,qz REAL,qw REAL,"
     "revision INTEGER"},
    {"edge", true, "session_a,stamp_a_ns,session_b,stamp_b_ns,kind,source",
     "session_a TEXT,stamp_a_ns INTEGER,session_b TEXT,stamp_b_ns INTEGER,kind TEXT,source TEXT,"
     "x REAL,y REAL,z REAL,qx REAL,qy REAL,qz REAL,qw REAL,information BLOB,weight REAL,verdict TEXT,"
     "reason TEXT"},
    {"evidence", false, "session_a,stamp_a_ns,session_b,stamp_b_ns,kind,source",
     "session_a TEXT,stamp_a_ns INTEGER,session_b TEXT,stamp_b_ns INTEGER,kind TEXT,source TEXT,"
     "data BLOB"},
    {"scan", false, "session,laser,second", "session TEXT,laser TEXT,second INTEGER,scans INTEGER,data BLOB"},
    {"keyframe", false, "session,camera,stamp_ns",
     "session TEXT,camera TEXT,stamp_ns INTEGER,image BLOB,features BLOB"},
    {"input", false, "session,block", "session TEXT,block INTEGER,events INTEGER,data BLOB"},
    {"state", false, "session,stage,part", "session TEXT,stage TEXT,part INTEGER,parts INTEGER,data BLOB"},
};

/// Creates an empty store as programs of schema 2 did.
void createVersion2(const std::string& path) {
  Connection connection(path, Connection::Mode::Create);
  connection.execute("PRAGMA auto_vacuum=INCREMENTAL");
  connection.execute(
      "CREATE TABLE tally(name TEXT NOT NULL,session TEXT NOT NULL,count INTEGER NOT NULL,sum INTEGER NOT NULL,"
      "PRIMARY KEY(name,session)) WITHOUT ROWID");
  for (const TableOfVersion2& table : kVersion2) {
    std::string columns = table.columns + ",";
    for (std::size_t at = 0; (at = columns.find(',', at)) != std::string::npos; at += 10)
      columns.insert(at, " NOT NULL");
    const std::string session = table.columns.substr(0, table.columns.find(' '));
    const std::string& name = table.name;
    const std::string of_session = " WHERE name='" + name + "' AND session=";
    connection.execute("CREATE TABLE " + name + "(crc INTEGER NOT NULL," + columns + "PRIMARY KEY(" + table.keys +
                       "))" + (table.is_narrow ? " WITHOUT ROWID" : ""));
    connection.execute("CREATE TRIGGER " + name + "_in AFTER INSERT ON " + name + " BEGIN INSERT INTO tally VALUES('" +
                       name + "',new." + session +
                       ",1,new.crc) ON CONFLICT(name,session) DO UPDATE SET count=count+1,sum=sum+excluded.sum; END");
    connection.execute("CREATE TRIGGER " + name + "_out AFTER DELETE ON " + name +
                       " BEGIN UPDATE tally SET count=count-1,sum=sum-old.crc" + of_session + "old." + session +
                       "; END");
    connection.execute("CREATE TRIGGER " + name + "_new AFTER UPDATE ON " + name +
                       " BEGIN UPDATE tally SET sum=sum-old.crc+new.crc" + of_session + "new." + session + "; END");
  }
  connection.execute("PRAGMA application_id=1431200118; PRAGMA user_version=2");
}

constexpr int kLater = 1000;  // a version that no release has

struct Landmark {
  SessionId session;
  std::int64_t number = 0;
  urban_nav_core::Pose T_map_landmark;
  static Table table() {
    Table table{"landmark", 2};
    table.since = kLater;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("number", number);
    columns.pose(T_map_landmark);
  }
};

/// The table `property` with two more columns.
struct PropertyWithUnit {
  SessionId session;
  Property property;
  std::string unit = "m";
  double sigma = 0.5;
  static Table table() { return PropertyRow::table(); }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("name", property.name);
    columns.since(kLater);
    columns.text("unit", unit);
    columns.real("sigma", sigma);
    columns.since(1);
    columns.text("value", property.value);
  }
};

/// All tables of a hypothetical later version.
Tables laterTables() {
  Tables tables = schema::tables();
  for (const Table*& table : tables)
    if (table->name == "property") table = &declaredTable<PropertyWithUnit>();
  tables.push_back(&declaredTable<Landmark>());
  return tables;
}

class Migration : public ::testing::Test {
 protected:
  Migration() {
    createVersion2(path);
    Store store(path, Access::Write);
    id = testing::fill(store, 1, 12);
    store.sessions().put(id, Property{"length", "7"});
    store.commit();
    before = dump(store);
  }
  std::vector<PropertyWithUnit> properties(Connection& connection) {
    std::vector<PropertyWithUnit> all;
    PropertyWithUnit row;
    TableAccess(connection).forEach(declaredTable<PropertyWithUnit>(), id, AnyRow(row), [&] { all.push_back(row); });
    return all;
  }

  const Folder folder;
  const std::string path = folder.file("s.db");
  SessionId id;
  std::string before;
};

TEST_F(Migration, AFileOfSchema2IsAsThisProgramWouldMakeIt) {
  createVersion2(folder.file("old.db"));
  Connection old(folder.file("old.db"), Connection::Mode::Read);
  Connection created(folder.file("new.db"), Connection::Mode::Create);
  schema::create(created, schema::tables(), 2);
  for (const char* sql : {"SELECT count(*) FROM sqlite_master", "SELECT sum(length(sql)) FROM sqlite_master"})
    EXPECT_EQ(old.integer(sql), created.integer(sql));
  EXPECT_NO_THROW(schema::check(old));
  EXPECT_NO_THROW(schema::check(created));
}

TEST_F(Migration, AddsTablesAndColumnsAndKeepsAllRows) {
  Connection connection(path, Connection::Mode::Write);
  schema::migrate(connection, laterTables());
  EXPECT_EQ(schema::version(connection), kLater);
  EXPECT_NO_THROW(schema::check(connection, laterTables()));
  const std::vector<PropertyWithUnit> rows = properties(connection);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].property.name, "length");
  EXPECT_EQ(rows[0].property.value, "7");
  EXPECT_EQ(rows[0].unit, "m");
  EXPECT_EQ(rows[0].sigma, 0.5);
  TableAccess tables(connection);
  tables.put(declaredTable<PropertyWithUnit>(), unchanged(PropertyWithUnit{id, {"length", "8"}, "mm", 0.25}));
  tables.put(declaredTable<Landmark>(), unchanged(Landmark{id, 4, testing::Drawn(1).pose()}));
  connection.commit();
  EXPECT_EQ(properties(connection)[0].unit, "mm");
  Landmark landmark{id, 4, {}};
  ASSERT_TRUE(tables.find(declaredTable<Landmark>(), AnyRow(landmark)));
  EXPECT_TRUE(urban_nav_core::isApprox(landmark.T_map_landmark, testing::Drawn(1).pose(), 1e-15));
  EXPECT_EQ(connection.integer("SELECT sum(count) FROM tally WHERE name='node'"), 12);
  schema::migrate(connection, laterTables());
  EXPECT_EQ(properties(connection).size(), 2U) << "no further migration";
}

TEST_F(Migration, KeepsTheRowsOfTablesWhoseLayoutChanges) {
  const std::string older = folder.file("older.db");
  {
    Connection connection(older, Connection::Mode::Create);
    constexpr int kOlder = 11;
    schema::create(connection, schema::tables(), kOlder);
    Connection present(path, Connection::Mode::Read);
    for (const Table* table : schema::tables()) {
      if (table->since > kOlder) continue;
      const Table then = schema::atVersion(*table, kOlder);
      RowReader reader(present, *table, "");
      while (reader.next()) {
        Row row = readRow(reader);
        row.resize(then.columns.size());  // added columns are the last ones
        RowWriter writer(connection, insertSql(then));
        writeRow(writer, row);
      }
    }
    connection.commit();
  }
  for (const Access access : {Access::Read, Access::Write}) {  // the second one migrates it
    Store store(older, access);
    EXPECT_TRUE(dump(store) == before);
  }
  Connection migrated(older, Connection::Mode::Read), created(path, Connection::Mode::Read);
  const char* const by_index = "SELECT count(*) FROM sqlite_master WHERE sql LIKE '%WITHOUT ROWID'";
  EXPECT_EQ(migrated.integer(by_index), created.integer(by_index));
  EXPECT_EQ(migrated.integer("SELECT count(*) FROM node WHERE rowid>0"), 12);
}

TEST_F(Migration, AnOlderFileIsReadAsItIs) {
  Connection connection(path, Connection::Mode::Read);
  const std::vector<PropertyWithUnit> rows = properties(connection);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].property.value, "7");
  EXPECT_EQ(rows[0].unit, "m");
  Landmark landmark;
  TableAccess tables(connection);
  EXPECT_FALSE(tables.has(declaredTable<Landmark>()));
  EXPECT_FALSE(tables.find(declaredTable<Landmark>(), AnyRow(landmark)));
  tables.forEach(declaredTable<Landmark>(), id, AnyRow(landmark), [] { FAIL(); });
  connection.close();
  EXPECT_TRUE(Store(path, Access::Read).sessions().find(id));
}

TEST_F(Migration, HappensAsAWholeOrNotAtAll) {
  {
    Connection connection(path, Connection::Mode::Write);
    connection.execute("CREATE TABLE landmark(a)");
    expectError([&] { schema::migrate(connection, laterTables()); }, path, "SQLite error");
    EXPECT_LT(schema::version(connection), kLater);
    connection.execute("DROP TABLE landmark");
  }
  Store store(path, Access::Read);
  EXPECT_EQ(dump(store), before);
}

TEST_F(Migration, ALostRowIsReportedBeforeItsTableIsRewritten) {
  Connection connection(path, Connection::Mode::Write);
  connection.execute("UPDATE tally SET count=count+1 WHERE name='property'");
  expectError([&] { schema::migrate(connection, laterTables()); }, path, "do not match the 3 written");
}

}  // namespace
}  // namespace urban_nav_store
