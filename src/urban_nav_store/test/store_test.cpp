// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/store.hpp"

#include <gtest/gtest.h>

#include "sqlite/connection.hpp"
#include "support/contents.hpp"
#include "support/folder.hpp"
#include "urban_nav_store/dump.hpp"

namespace urban_nav_store {
namespace {

using testing::Drawn;
using testing::expectError;
using testing::fill;
using testing::Folder;
using testing::readFile;
using testing::writeFile;

TEST(Store, HoldsWhatWasCommittedAndNothingElse) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  std::string before;
  {
    Store store(path, Access::Write);
    fill(store, 1, 30);
    store.commit();
    before = dump(store);
    fill(store, 2, 30);
    EXPECT_FALSE(dump(store) == before) << "uncommitted writes are visible to the writer";
  }
  EXPECT_EQ(folder.files(), 1U) << "no auxiliary files after closing";
  Store store(path, Access::Read);
  EXPECT_TRUE(dump(store) == before);
  EXPECT_EQ(store.sessions().all().size(), 1U);
}

TEST(Store, TheSameCallsGiveTheSameContentWheneverItIsCommitted) {
  const Folder folder;
  std::string once, often;
  {
    Store store(folder.file("once.db"), Access::Write);
    fill(store, 1, 200);
    store.commit();
    once = dump(store);
  }
  {
    Store store(folder.file("often.db"), Access::Write);
    Drawn drawn(5);
    const Session session = drawn.session();
    store.sessions().put(session);
    Store other(folder.file("at_once.db"), Access::Write);
    other.sessions().put(session);
    for (int i = 0; i < 200; ++i) {
      const urban_nav_core::Scan scan = drawn.scan(session.start + 13'000'000LL * i, 30);
      for (Store* each : {&store, &other}) {
        each->scans().put(session.id, "laser_left", scan);
        each->inputs().append(session.id, {"laser_left", scan.stamp, true});
      }
      if (i % 7 == 0) store.commit();
    }
    store.commit();
    other.commit();
    EXPECT_TRUE(dump(store) == dump(other));
  }
  Store again(folder.file("again.db"), Access::Write);
  fill(again, 1, 200);
  EXPECT_TRUE(dump(again) == once);
}

TEST(Store, ReadingChangesNoByte) {
  const Folder folder;
  const std::string path = folder.file("a #?%20 name.db");
  {
    Store store(path, Access::Write);
    fill(store, 1, 30);
    store.commit();
  }
  const std::string bytes = readFile(path);
  {
    Store store(path, Access::Read);
    dump(store);
    expectError([&] { fill(store, 2, 3); }, path, "was opened for reading only");
    EXPECT_EQ(folder.files(), 1U);
  }
  EXPECT_EQ(readFile(path), bytes);
}

TEST(Store, AReaderReadsCommitsOfALiveWriter) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  Store writer(path, Access::Write);
  fill(writer, 1, 10);
  writer.commit();
  const std::string committed = dump(writer);
  fill(writer, 2, 10);
  Store reader(path, Access::Read);
  EXPECT_TRUE(dump(reader) == committed);
  writer.commit();
  EXPECT_TRUE(dump(reader) == dump(writer));
}

TEST(Store, HasOneWriter) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  {
    const Store first(path, Access::Write);
    expectError([&] { Store(path, Access::Write); }, path, "is being written by another program");
    expectError([&] { removeStore(path); }, path, "is being written by another program");
  }
  EXPECT_NO_THROW(Store(path, Access::Write));
}

TEST(Store, ReportsThatItIsClosed) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  Store store(path, Access::Write);
  GraphStore& graph = store.graph();
  fill(store, 1, 3);
  store.close();
  store.close();
  expectError([&] { graph.nodes("x"); }, path, "is closed");
  expectError([&] { fill(store, 1, 3); }, path, "is closed");
  expectError([&] { store.commit(); }, path, "is closed");
  expectError([&] { dump(store); }, path, "is closed");
  Store again(path, Access::Read);
  EXPECT_TRUE(again.sessions().all().empty()) << "it was closed before the commit";
}

TEST(Store, LeavesOtherFilesAlone) {
  const Folder folder;
  const std::string text = folder.file("text.db"), other = folder.file("other.db"), newer = folder.file("newer.db");
  writeFile(text, "#ROSBAG V2.0\n" + std::string(500, 'x'));
  {
    Connection connection(other, Connection::Mode::Create);
    connection.execute("CREATE TABLE theirs(a); INSERT INTO theirs VALUES(1)");
    Store store(newer, Access::Write);
    store.close();
    Connection version(newer, Connection::Mode::Write);
    version.execute("PRAGMA user_version=" + std::to_string(schemaVersion() + 1));
    version.close();
  }
  for (const Access access : {Access::Read, Access::Write}) {
    for (const auto& [path, words] :
         {std::pair{text, "is not a session store"}, {other, "is another program's"}, {newer, "newer urban_nav"}}) {
      const std::string bytes = readFile(path);
      expectError([&, path = path] { Store(path, access); }, path, words);
      EXPECT_EQ(readFile(path), bytes);
    }
    expectError([&] { Store(folder.file(""), access); }, folder.file(""), "is not a session store");
  }
  for (const std::string& path : {text, other}) expectError([&] { removeStore(path); }, path, "was not changed");
  EXPECT_TRUE(isStore(newer));
  EXPECT_FALSE(isStore(other));
  EXPECT_FALSE(isStore(text));
  EXPECT_FALSE(isStore(folder.file("nothing")));
  EXPECT_EQ(folder.files(), 3U);
}

TEST(Store, ReportsAnUnusablePath) {
  const Folder folder;
  const std::string nowhere = folder.file("no/such/folder/s.db"), absent = folder.file("absent.db");
  expectError([&] { Store(nowhere, Access::Write); }, nowhere, "cannot be written");
  expectError([&] { Store(nowhere, Access::Read); }, nowhere, "does not exist");
  expectError([&] { Store(absent, Access::Read); }, absent, "does not exist");
  expectError([&] { Store("/proc/urban_nav.db", Access::Write); }, "/proc/urban_nav.db", "cannot be written");
  EXPECT_EQ(folder.files(), 0U);
}

TEST(Store, IsRemovedWithAllThatBelongsToIt) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  {
    Store store(path, Access::Write);
    fill(store, 1, 3);
    store.commit();
  }
  removeStore(path);
  EXPECT_EQ(folder.files(), 0U);
  removeStore(path);
  writeFile(path + "-wal", "of a store whose file is gone");
  Store store(path, Access::Write);
  EXPECT_TRUE(store.sessions().all().empty());
}

TEST(Store, GivesRoomBack) {
  const Folder folder;
  const std::string path = folder.file("s.db");
  std::string kept;
  {
    Store store(path, Access::Write);
    const SessionId id = fill(store, 1, 10);
    kept = dump(store);
    store.states().put(id, "large", Drawn(1).bytes(3'000'000));
    store.commit();
    store.states().remove(id, "large");
    store.shrink();
  }
  EXPECT_LT(std::filesystem::file_size(path), 300'000U);
  Store store(path, Access::Read);
  EXPECT_TRUE(dump(store) == kept);
}

TEST(Store, ALinkStaysALink) {
  const Folder folder;
  std::filesystem::create_symlink("real.db", folder.file("link.db"));
  {
    Store store(folder.file("real.db"), Access::Write);
    fill(store, 1, 3);
    store.commit();
  }
  Store writer(folder.file("link.db"), Access::Write);
  EXPECT_EQ(writer.sessions().all().size(), 1U);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.db")));
  expectError([&] { Store(folder.file("real.db"), Access::Write); }, folder.file("real.db"), "is being written");
}

}  // namespace
}  // namespace urban_nav_store
