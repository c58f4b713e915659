// SPDX-License-Identifier: BSD-3-Clause
// The levels of detail of a map as the server of the page serves them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "edits/circle_store.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"
#include "view/served_store.hpp"
#include "view/tiled_store.hpp"

namespace urban_nav {
namespace {

using Eigen::Vector3d;
using laser_mapper::TilePoint;
using testing::ServedStore;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_store::Access;
using urban_nav_store::Store;

constexpr std::size_t kMove = 10;  // numbers of a pose in /api/moves

class ViewTiles : public ::testing::Test {
 protected:
  ViewTiles() {
    testing::writeCircleStore(store_);
    points_ = testing::addTiles(store_);
  }

  static nlohmann::json readList(const ServedStore& served, const std::string& words = "") {
    return nlohmann::json::parse(served.get("/api/tiles" + words).body);
  }

  /// Tile and number of points of a row of the list.
  static std::pair<laser_mapper::LevelTile, std::size_t> parseRow(const std::string& row) {
    const std::size_t blank = row.find(' ');
    return {laser_mapper::parseLevelTile(row.substr(0, blank)).value(), std::stoul(row.substr(blank))};
  }

  /// All points of a set that the server serves.
  static std::vector<TilePoint> servedPoints(const ServedStore& served) {
    std::vector<TilePoint> all;
    const nlohmann::json list = readList(served);
    for (const auto& row : list["sets"].at(0)["tiles"]) {
      const auto [tile, points] = parseRow(row);
      const testing::RawAnswer answer = served.get("/api/tile?set=0&tile=" + toString(tile));
      EXPECT_EQ(answer.status, 200);
      EXPECT_NE(answer.head.find("Content-Encoding: deflate"), std::string::npos) << answer.head;
      std::string packed;
      urban_nav_store::appendInteger(packed, points * laser_mapper::kTilePointBytes);
      const auto bytes = urban_nav_store::inflated(packed + answer.body, std::size_t{1} << 30);
      const auto read = bytes ? laser_mapper::readTile(tile, *bytes) : std::nullopt;
      EXPECT_TRUE(read && read->size() == points) << toString(tile);
      if (read) all.insert(all.end(), read->begin(), read->end());
    }
    return all;
  }

  /// Motion of the poses of both sessions; empty for one that stays.
  static std::vector<std::vector<float>> readMoves(const ServedStore& served) {
    const std::string bytes = served.get("/api/moves").body;
    std::vector<std::vector<float>> moves;
    for (std::size_t at = 0; at < bytes.size();) {
      std::uint32_t poses = 0;
      std::memcpy(&poses, bytes.data() + at, sizeof poses);
      std::vector<float> numbers(kMove * poses);
      std::memcpy(numbers.data(), bytes.data() + at + 4, 4 * numbers.size());
      moves.push_back(numbers);
      at += 4 + 4 * numbers.size();
    }
    return moves;
  }

  const TemporaryFolder folder_;
  const std::string store_ = folder_.file("s.db");
  std::size_t points_ = 0;
};

TEST_F(ViewTiles, EachPointIsServedOnce) {
  const ServedStore served(store_, true);
  const auto list = readList(served);
  ASSERT_EQ(list["sets"].size(), 1U);
  EXPECT_EQ(list["sets"][0]["sessions"], nlohmann::json({testing::kMondayId, testing::kTuesdayId}));
  EXPECT_EQ(list["sets"][0]["voxel"], testing::kTiledVoxel);
  EXPECT_EQ(parseRow(list["sets"][0]["tiles"][0]).first.level, laser_mapper::kCoarsestLevel) << "coarse levels first";
  EXPECT_EQ(servedPoints(served).size(), points_);
  for (const std::vector<float>& moves : readMoves(served)) EXPECT_TRUE(moves.empty());
}

TEST_F(ViewTiles, AnExtentAndABudgetSelectTiles) {
  const ServedStore served(store_, true);
  const auto countPoints = [](const nlohmann::json& list) {
    std::size_t sum = 0;
    for (const auto& row : list["sets"][0]["tiles"]) sum += parseRow(row).second;
    return sum;
  };
  EXPECT_EQ(countPoints(readList(served)), points_);
  const std::size_t few = countPoints(readList(served, "?budget=3000"));
  EXPECT_TRUE(few > 0 && few <= 3000) << few;
  EXPECT_LT(countPoints(readList(served, "?extent=1,1,2,2")), points_);
  EXPECT_EQ(countPoints(readList(served, "?extent=9e5,9e5,9.1e5,9.1e5")), 0U);
  for (const char* words : {"?extent=", "?extent=1,2,3", "?extent=1,2,3,x", "?extent=1,2,3,inf", "?budget=-1",
                            "?budget=x", "?budget=1&budget=2"})
    EXPECT_EQ(served.get(std::string("/api/tiles") + words).status, 400) << words;
}

TEST_F(ViewTiles, TilesThatDoNotExistAreRefused) {
  const ServedStore served(store_, true);
  EXPECT_EQ(served.get("/api/tile?set=0&tile=0/9999,0").status, 404);
  EXPECT_EQ(served.get("/api/tile?set=7&tile=7/0,0").status, 404);
  for (const char* words : {"", "?set=0", "?tile=0/0,0", "?set=x&tile=0/0,0", "?set=0&tile=0", "?set=0&tile=99/0,0",
                            "?set=0&tile=../../etc/passwd"})
    EXPECT_EQ(served.get(std::string("/api/tile") + words).status, 400) << words;
}

TEST_F(ViewTiles, PointsFollowTheirPosesAfterAnEditAndReturnAfterUndo) {
  std::vector<std::vector<Vector3d>> before(2);
  {
    Store store(store_, Access::Read);
    const auto maps = urban_nav_store::readMaps(store, urban_nav_store::selectSessions(store, {}));
    for (std::size_t s = 0; s < 2; ++s)
      for (const auto& pose : maps[0][s].T_map_base) before[s].push_back(pose.pose.t());
  }
  std::string digest;
  {
    const ServedStore served(store_);
    digest = readList(served)["sets"][0]["digest"];
    const auto edited =  // 0.3 m from where it is
        served.edit(R"({"action": "pin", "arguments": ["monday+20"], "options": {"at": "-8.4,15.2,0"}})");
    ASSERT_EQ(edited.status, 200) << edited.body;
    EXPECT_EQ(readList(served)["sets"][0]["digest"], digest) << "the tiles are the same";
  }
  const auto expectMoved = [&](const ServedStore& served) {
    Store store(store_, Access::Read);
    const auto maps = urban_nav_store::readMaps(store, urban_nav_store::selectSessions(store, {}));
    const auto moves = readMoves(served);
    ASSERT_EQ(moves.size(), 2U);
    double largest = 0.0;
    for (const TilePoint& point : servedPoints(served)) {
      const std::vector<float>& its = moves[point.session];
      ASSERT_FALSE(its.empty());
      const float* m = its.data() + kMove * point.pose;
      const Eigen::Quaterniond turn(m[3], m[0], m[1], m[2]);
      const Vector3d then(m[4], m[5], m[6]), now(m[7], m[8], m[9]), p = tilePlace(point, testing::kTiledVoxel);
      EXPECT_LT((then - before[point.session][point.pose]).norm(), 1e-5);
      const auto& pose = maps[0][point.session].T_map_base[point.pose].pose;
      // A rendering from scratch would put the point there; its height identifies it.
      const double z = std::round(10.0 * p.z()) / 10.0;
      const Vector3d expected = pose * Vector3d(0.0, 4.0, z);
      EXPECT_LT((turn * (p - then) + now - expected).norm(), 3e-4);
      largest = std::max(largest, (p - expected).norm());
    }
    EXPECT_GT(largest, 0.1) << "the edit moved the map";
  };
  {
    const ServedStore served(store_);  // another server: what it needs is in the store
    EXPECT_EQ(readList(served)["sets"][0]["digest"], digest);
    expectMoved(served);
    ASSERT_EQ(served.edit(R"({"action": "undo"})").status, 200);
    for (const std::vector<float>& moves : readMoves(served)) EXPECT_TRUE(moves.empty());
  }
}

TEST_F(ViewTiles, AStoreWithoutPointsHasNoTiles) {
  const std::string plain = folder_.file("plain.db");
  testing::writeCircleStore(plain);
  const ServedStore served(plain, true);
  EXPECT_TRUE(readList(served)["sets"].empty());
  EXPECT_EQ(served.get("/api/moves").body, "");
}

}  // namespace
}  // namespace urban_nav
