// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/merge.hpp"

#include <gtest/gtest.h>

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

class Merge : public ::testing::Test {
 protected:
  template <typename Write>
  std::string make(const std::string& name, const Write& write) {
    Store store(folder.file(name), Access::Write);
    write(store);
    store.commit();
    return folder.file(name);
  }
  std::string dumpStore(const std::string& path) {
    Store store(path, Access::Read);
    return dump(store);
  }
  const Folder folder;
  const std::string out = folder.file("out.db");
};

TEST_F(Merge, JoinsOtherSessionsInAnyOrder) {
  const std::string a = make("a.db", [](Store& store) { fill(store, 1, 20); });
  const std::string b = make("b.db", [](Store& store) { fill(store, 2, 20); });
  const std::string both = make("both.db", [](Store& store) { fill(store, 2, 20), fill(store, 1, 20); });
  const MergeResult result = merge({a, b}, out);
  EXPECT_TRUE(dumpStore(out) == dumpStore(both));
  EXPECT_EQ(result.identical, 0);
  merge({b, a}, out);
  EXPECT_TRUE(dumpStore(out) == dumpStore(both)) << "replaces the previous file";
  const MergeResult again = merge({out, a}, out);
  EXPECT_TRUE(dumpStore(out) == dumpStore(both)) << "into one of the sources";
  EXPECT_EQ(again.rows, result.rows);
  EXPECT_GT(again.identical, 50);
}

TEST_F(Merge, KeepsNoStateThatTwoRunsDisagreeOn) {
  const std::string long_state = Drawn(3).bytes(2'500'000);
  const auto with = [&](const std::string& name, const std::string& state) {
    return make(name, [&](Store& store) {
      fill(store, 1, 5);
      const SessionId id = store.sessions().all().front().id;
      store.states().put(id, "bag", state);
      store.states().put(id, "same", "bytes");
    });
  };
  const std::string a = with("a.db", long_state), b = with("b.db", "short"), c = with("c.db", "short");
  for (const auto& sources : {std::vector<std::string>{a, b}, {b, a}, {a, b, a}}) {
    const MergeResult result = merge(sources, out);
    Store store(out, Access::Read);
    const SessionId id = store.sessions().all().front().id;
    EXPECT_FALSE(store.states().get(id, "bag"));
    EXPECT_EQ(store.states().get(id, "same"), "bytes");
    store.close();
    EXPECT_EQ(merge({out}, folder.file("copy.db")).rows, result.rows);
  }
  merge({b, c}, out);
  Store store(out, Access::Read);
  EXPECT_EQ(store.states().get(store.sessions().all().front().id, "bag"), "short");
}

TEST_F(Merge, JoinsThePartsOfOneSession) {
  Drawn drawn(1);
  Session session = drawn.session();
  session.complete = true;
  const Node node = drawn.node(session.start);
  const urban_nav_core::Scan scan = drawn.scan(session.start, 30);
  const std::string a = make("a.db", [&](Store& store) {
    store.sessions().put(session);
    store.graph().put(session.id, node);
  });
  session.complete = false;
  const std::string b = make("b.db", [&](Store& store) {
    store.sessions().put(session);
    store.scans().put(session.id, "laser_left", scan);
  });
  merge({a, b}, out);
  Store store(out, Access::Read);
  ASSERT_EQ(store.sessions().all().size(), 1U);
  EXPECT_FALSE(store.sessions().all().front().complete);
  EXPECT_EQ(store.graph().nodes(session.id), 1);
  EXPECT_EQ(store.scans().lasers(session.id), std::vector<std::string>{"laser_left"});
}

TEST_F(Merge, NamesWhatContradicts) {
  const std::string a = make("a.db", [](Store& store) { fill(store, 1, 20); });
  SessionId id;
  const std::string b = make("b.db", [&](Store& store) {
    id = fill(store, 1, 20);
    Drawn drawn(7);
    for (int i = 0; i < 8; ++i) {
      std::optional<Node> node;
      store.graph().forEachNode(id, [&](const Node& each) {
        if (!node) node = each;
      });
      Node other = *node;
      other.stamp += 50'000'001LL * i;
      store.graph().put(id, other);
    }
    store.sessions().put(id, StoredParameter{"swf_vo.window", "26", "default"});
  });
  writeFile(out, "");
  expectError([&] { merge({a, b}, out); }, out, "7 rows contradict each other; node session=" + id);
  EXPECT_EQ(readFile(out), "");
  EXPECT_EQ(folder.files(), 3U);
}

TEST_F(Merge, TakesWhatDescribesARunFromOneOfThem) {
  SessionId id;
  const auto with = [&](const std::string& name, const std::string& value, const std::string& path) {
    return make(name, [&](Store& store) {
      id = fill(store, 1, 5);
      store.sessions().put(id, StoredParameter{"command.memory_mb", value, value == "500" ? "default" : path});
      store.sessions().put(id, Property{"run/inputs", path});
      store.sessions().put(id, Property{"input/name", path});
    });
  };
  const std::string a = with("a.db", "500", "/first/drive.bag"), b = with("b.db", "900", "/second/drive.bag");
  merge({a, b}, out);
  EXPECT_TRUE(dumpStore(out) == dumpStore(a));
  merge({b, a}, out);
  EXPECT_TRUE(dumpStore(out) == dumpStore(a));
}

TEST_F(Merge, TakesTheLaterRevisionOfTheGraph) {
  const auto with = [](std::int64_t revision, std::uint32_t seed) {
    return [=](Store& store) {
      Drawn drawn(seed);
      store.sessions().put(Session{"s", "", "", "", 0, false});
      store.graph().put("s", RelaxedPose{5, drawn.pose(), revision});
      store.sessions().put(Anchor{"s", "s", revision, drawn.pose()});
    };
  };
  const std::string a = make("a.db", with(3, 1)), b = make("b.db", with(4, 2)), c = make("c.db", with(4, 3));
  for (const auto& sources : {std::vector<std::string>{a, b}, {b, a}}) {
    EXPECT_EQ(merge(sources, out).outdated, 2);
    EXPECT_TRUE(dumpStore(out) == dumpStore(b));
  }
  expectError([&] { merge({b, c}, out); }, out, "contradict");
  EXPECT_TRUE(dumpStore(out) == dumpStore(b)) << "the existing file is unchanged";
}

TEST_F(Merge, RefusesWhatIsNoStore) {
  const std::string a = make("a.db", [](Store& store) { fill(store, 1, 5); });
  writeFile(folder.file("text"), "words");
  expectError([&] { merge({a, folder.file("text")}, out); }, folder.file("text"), "is not a session store");
  expectError([&] { merge({a, folder.file("none")}, out); }, folder.file("none"), "does not exist");
  expectError([&] { merge({a}, folder.file("text")); }, folder.file("text"), "is not a session store");
  std::string damaged = readFile(a);
  damaged.replace(5 * 4096, 4096, 4096, '\xff');
  writeFile(folder.file("damaged.db"), damaged);
  expectError([&] { merge({a, folder.file("damaged.db")}, out); }, folder.file("damaged.db"), "is damaged");
  EXPECT_EQ(readFile(folder.file("text")), "words");
  EXPECT_EQ(folder.files(), 3U);
}

TEST_F(Merge, DoesNotTakeAStoreFromItsWriter) {
  const std::string a = make("a.db", [](Store& store) { fill(store, 1, 5); });
  Store writer(out, Access::Write);
  expectError([&] { merge({a}, out); }, out, "is being written by another program");
}

}  // namespace
}  // namespace urban_nav_store
