// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/release.hpp"

#include <gtest/gtest.h>

#include "support/contents.hpp"
#include "support/folder.hpp"
#include "urban_nav_store/dump.hpp"
#include "urban_nav_store/merge.hpp"

namespace urban_nav_store {
namespace {

using testing::expectError;
using testing::fill;
using testing::Folder;
using testing::readFile;

class Release : public ::testing::Test {
 protected:
  /// Creates a store, and a release of it.
  ReleaseHead make(const std::string& name, std::uint32_t seed, ReleaseHead head = {}) {
    {
      Store store(folder.file("source.db"), Access::Write);
      id = fill(store, seed, 20);
      store.commit();
    }
    ReleaseHead written = freeze(folder.file("source.db"), id, std::move(head), folder.file(name));
    removeStore(folder.file("source.db"));
    return written;
  }
  const Folder folder;
  SessionId id;
};

TEST_F(Release, HoldsTheRowsAndWhatItIs) {
  const ReleaseHead written = make("a.release", 1, {4, "", {"parent", "grandparent"}});
  EXPECT_TRUE(isRelease(folder.file("a.release")));
  Store release(folder.file("a.release"), Access::Frozen);
  const ReleaseHead read = readReleaseHead(release);
  EXPECT_EQ(read.version, 4);
  EXPECT_EQ(read.digest, written.digest);
  EXPECT_EQ(read.digest.size(), 64U);
  EXPECT_EQ(read.parents, (std::vector<std::string>{"parent", "grandparent"}));
  EXPECT_EQ(release.graph().nodes(id), 20);
  EXPECT_EQ(folder.files(), 1U) << "nothing but the release";
}

TEST_F(Release, SameRowsGiveTheSameBytes) {
  const ReleaseHead one = make("a.release", 1), two = make("b.release", 1), other = make("c.release", 2);
  EXPECT_TRUE(readFile(folder.file("a.release")) == readFile(folder.file("b.release")));
  EXPECT_EQ(one.digest, two.digest);
  EXPECT_NE(one.digest, other.digest);
}

TEST_F(Release, IsRefusedWhereAStoreIsWanted) {
  make("a.release", 1);
  const std::string path = folder.file("a.release"), before = readFile(path);
  for (const Access access : {Access::Read, Access::Snapshot, Access::Write})
    expectError([&] { const Store store(path, access); }, path, "is a release");
  expectError([&] { merge({path}, folder.file("out.db")); }, path, "is a release");
  expectError([&] { merge({path}, path); }, path, "is a release");
  expectError([&] { removeStore(path); }, path, "is a release");
  EXPECT_TRUE(readFile(path) == before);
  EXPECT_FALSE(isRelease(folder.file("none")));
}

TEST_F(Release, RowsCanBeCopiedOutOfItByTheirKeys) {
  make("a.release", 1);
  const auto isNode = [](const Table& table, const std::vector<Value>&) {
    return table.name == "session" || table.name == "node";
  };
  copyRows(folder.file("a.release"), folder.file("out.db"), isNode);
  Store out(folder.file("out.db"), Access::Read);
  EXPECT_EQ(out.graph().nodes(id), 20);
  EXPECT_TRUE(out.scans().lasers(id).empty());
  EXPECT_TRUE(out.sessions().properties(id).empty());
}

TEST_F(Release, DamageIsReported) {
  make("a.release", 1);
  std::string bytes = readFile(folder.file("a.release"));
  testing::writeFile(folder.file("cut.release"), bytes.substr(0, bytes.size() / 2));
  expectError([&] { const Store store(folder.file("cut.release"), Access::Frozen); }, folder.file("cut.release"),
              "is damaged");
}

}  // namespace
}  // namespace urban_nav_store
