// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/table_store.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/contents.hpp"
#include "support/folder.hpp"
#include "tables/graph_tables.hpp"
#include "tables/measurement_tables.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::Drawn;
using testing::expectError;
using testing::Folder;

class RowsOfATable : public ::testing::Test {
 protected:
  const Folder folder;
  const std::string path = folder.file("s.db");
  Store store{path, Access::Write};
};

TEST_F(RowsOfATable, RowsComeBackInTheOrderOfTheirKeys) {
  TableStore<KeyframeRow> keyframes(store);
  for (const std::int64_t stamp : {7, 5, -2})
    keyframes.put({"s", "left", {stamp, "image" + std::to_string(stamp), ""}});
  keyframes.put({"s", "right", {6, "other camera", ""}});
  keyframes.put({"t", "left", {6, "other session", ""}});
  keyframes.put({"s", "left", {5, "replaced", "features"}});
  std::vector<std::string> images;
  keyframes.forEach("s", [&](const KeyframeRow& row) { images.push_back(row.keyframe.image); });
  EXPECT_EQ(images, (std::vector<std::string>{"image-2", "replaced", "image7", "other camera"}));
  images.clear();
  keyframes.forEachBetween({"s", "left", {}}, -1, 7,
                           [&](const KeyframeRow& row) { images.push_back(row.keyframe.image); });
  EXPECT_EQ(images, (std::vector<std::string>{"replaced", "image7"}));
  EXPECT_EQ(keyframes.keysBetween({"s", "left", {}}, -2, 6), (std::vector<std::int64_t>{-2, 5}));
  const std::optional<KeyframeRow> found = keyframes.get({"s", "left", {5, "", ""}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->keyframe.features, "features");
  keyframes.remove({"s", "left", {5, "", ""}});
  EXPECT_FALSE(keyframes.get({"s", "left", {5, "", ""}}));
  EXPECT_TRUE(keyframes.get({"s", "left", {7, "", ""}}));
}

TEST_F(RowsOfATable, AreReadFromOneStateWhateverIsCommittedMeanwhile) {
  TableStore<KeyframeRow> written(store);
  written.put({"s", "left", {1, "first", ""}});
  written.put({"s", "left", {2, "second", ""}});
  store.commit();
  Store following(path, Access::Read), snapshot(path, Access::Snapshot);
  std::int64_t stamp = 2;
  const auto countWhileWriting = [&](Store& reader) {
    int rows = 0;
    TableStore<KeyframeRow>(reader).forEach("s", [&](const KeyframeRow&) {
      ++rows;
      written.put({"s", "left", {++stamp, "later", ""}});
      store.commit();
    });
    return rows;
  };
  EXPECT_EQ(countWhileWriting(following), 2) << "rows and count are of one state";
  EXPECT_EQ(countWhileWriting(following), 4) << "the next call reads committed rows";
  EXPECT_EQ(countWhileWriting(snapshot), 2) << "a snapshot of the file at opening";
}

TEST_F(RowsOfATable, AStateIsReadWithAllItsParts) {
  const std::string first(3 << 20, 'a'), second(1 << 20, 'b');
  store.states().put("s", "vo", first);
  store.commit();
  Store snapshot(path, Access::Snapshot);
  store.states().put("s", "vo", second);
  store.commit();
  EXPECT_EQ(snapshot.states().get("s", "vo"), first);
  EXPECT_EQ(Store(path, Access::Read).states().get("s", "vo"), second);
}

TEST_F(RowsOfATable, PosesMatricesAndWordsComeBackBitByBit) {
  Drawn drawn(1);
  const Node node = drawn.node(3);
  TableStore<NodeRow>(store).put({"s", node});
  NodeRow key{"s", {}};
  key.node.stamp = 3;
  const std::optional<NodeRow> found = TableStore<NodeRow>(store).get(key);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->node.T_odom_base.t(), node.T_odom_base.t());
  EXPECT_EQ(found->node.covariance, node.covariance);
  EXPECT_EQ(found->node.drift_covariance, node.drift_covariance);
  EXPECT_EQ(found->node.status, node.status);
}

TEST_F(RowsOfATable, InvalidRowsAreRefusedAndNothingIsWritten) {
  TableStore<NodeRow> nodes(store);
  NodeRow row{"s", Drawn(1).node(3)};
  row.node.drift_covariance(5, 5) = std::numeric_limits<double>::infinity();
  expectError([&] { nodes.put(row); }, path,
              "the row of node with session=s, stamp_ns=3 is invalid: drift is not finite");
  EXPECT_FALSE(nodes.get(row));
}

TEST_F(RowsOfATable, AStoreOpenedForReadingIsNotWritten) {
  store.close();
  Store reader(path, Access::Read);
  TableStore<KeyframeRow> keyframes(reader);
  expectError([&] { keyframes.put({"s", "left", {}}); }, path, "was opened for reading only");
  expectError([&] { keyframes.remove({"s", "left", {}}); }, path, "was opened for reading only");
}

}  // namespace
}  // namespace urban_nav_store
