// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "commands/stages.hpp"
#include "convert/convert.hpp"
#include "inspect/inspect.hpp"
#include "inspect/store_export.hpp"
#include "inspect/store_info.hpp"
#include "map/map_command.hpp"
#include "topics/places/place_export.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/g2o.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_store/dump.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_model.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Pose;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_store::Access;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::Store;

int call(std::vector<std::string> words) {
  std::vector<const char*> argv = {"urban_nav"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  return runCommandLine({mapCommand(makeStages), infoCommand(), exportCommand(), mergeCommand()}, addStageTables,
                        static_cast<int>(argv.size()), argv.data());
}

/// Two folders, each mapped into a separate store, and both into one.
class StoreCommands : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    for (const int frames : {16, 12}) {
      urban_nav_input::testing::KittiStyle style;
      style.frames = frames;
      urban_nav_input::testing::makeKittiFolder(file("in" + std::to_string(frames)), style);
    }
    ASSERT_EQ(call({"map", file("in16"), "--out", file("a"), "--stages", "vo"}), 0);
    ASSERT_EQ(call({"map", file("in12"), "--out", file("b"), "--stages", "vo"}), 0);
    ASSERT_EQ(call({"map", file("in16"), file("in12"), "--out", file("both"), "--stages", "vo"}), 0);
  }
  static void TearDownTestSuite() { shared_.reset(); }
  static std::string file(const std::string& name) { return shared_->file(name); }
  static std::string dumpStore(const std::string& path) {
    Store store(path, Access::Read);
    return dump(store);
  }

 private:
  static std::unique_ptr<TemporaryFolder> shared_;
};
std::unique_ptr<TemporaryFolder> StoreCommands::shared_;

TEST_F(StoreCommands, InfoListsTheContentsOfAStore) {
  const StoreInfo info = readStoreInfo(file("both/session.db"));
  ASSERT_EQ(info.sessions.size(), 2U);
  EXPECT_EQ(info.joined.size(), 2U) << "nothing joins them";
  const StoredSession& session = info.sessions.front().nodes == 16 ? info.sessions.front() : info.sessions.back();
  EXPECT_EQ(session.session.name, "in16");
  EXPECT_TRUE(session.session.complete);
  EXPECT_FALSE(session.resumable);
  EXPECT_EQ(session.nodes, 16);
  EXPECT_NEAR(urban_nav_core::secondsBetween(session.first, session.last), 0.75, 1e-9);
  EXPECT_NEAR(session.length_m, urban_nav_core::readTum(file("a/trajectory.tum")).length(), 1e-9);
  EXPECT_EQ(session.edges.at("odometry").at("accepted"), 15);
  ASSERT_EQ(session.streams.size(), 1U);
  EXPECT_EQ(session.streams.front().messages, 16);
  EXPECT_NEAR(session.streams.front().rate_hz, 20.0, 1e-6);
  EXPECT_EQ(session.frames, std::vector<std::string>{"stereo_left_optical_frame"});
  const std::string text = toText(info);
  for (const char* words :
       {"2 sessions", "in12", "nodes 16", "odometry: 15 accepted", "stream stereo: 16 at 20 Hz", "base_link"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
  EXPECT_EQ(call({"info", file("both/session.db"), "--json", file("info.json")}), 0);
  EXPECT_NE(readFile(file("info.json")).find("\"kind\": \"session store\""), std::string::npos);
}

TEST_F(StoreCommands, ExportsTheBytesThatMapWrote) {
  ASSERT_EQ(call({"export", file("a/session.db"), "--tum", file("x.tum"), "--kitti", file("x.kitti"), "--g2o",
                  file("x.g2o"), "--json", file("x.json")}),
            0);
  EXPECT_EQ(readFile(file("x.tum")), readFile(file("a/trajectory.tum")));
  EXPECT_EQ(readFile(file("x.kitti")), readFile(file("a/trajectory.kitti")));
  EXPECT_EQ(readFile(file("x.g2o")), readFile(file("a/graph.g2o")));
  EXPECT_NE(readFile(file("x.json")).find("x.g2o"), std::string::npos);
  ASSERT_EQ(call({"export", file("both/session.db"), "--session", "in12", "--tum", file("y.tum")}), 0);
  EXPECT_EQ(readFile(file("y.tum")), readFile(file("b/trajectory.tum")));
  ASSERT_EQ(call({"export", file("both/session.db"), "--tum", file("z.tum")}), 0);
  EXPECT_FALSE(readFile(file("z_2.tum")).empty()) << "a map of its own";
}

TEST_F(StoreCommands, MapGoesOnFromAStore) {
  const std::string first = dumpStore(file("a/session.db"));
  ASSERT_EQ(call({"map", file("in12"), "--out", file("on"), "--stages", "vo", "--store", file("a/session.db")}), 0);
  const auto sessionsIn = [](const std::string& path) { return readStoreInfo(path).sessions.size(); };
  EXPECT_EQ(sessionsIn(file("on/session.db")), 2U);
  EXPECT_TRUE(dumpStore(file("a/session.db")) == first) << "it is only read";
  EXPECT_EQ(readFile(file("on/trajectory.tum")), readFile(file("b/trajectory.tum")));
  ASSERT_EQ(call({"map", file("in12"), "--out", file("on"), "--stages", "vo", "--store", file("a/session.db")}), 0);
  EXPECT_EQ(sessionsIn(file("on/session.db")), 2U) << "again";
  ASSERT_EQ(call({"map", file("in12"), "--out", file("on"), "--stages", "vo", "--store", file("on/session.db")}), 0);
  EXPECT_EQ(sessionsIn(file("on/session.db")), 2U) << "its own, with the same session";
  ASSERT_EQ(call({"export", file("on/session.db"), "--session", "in16", "--tum", file("on.tum")}), 0);
  EXPECT_EQ(readFile(file("on.tum")), readFile(file("a/trajectory.tum")));
  EXPECT_EQ(call({"map", file("in12"), "--out", file("on"), "--stages", "vo", "--store", file("none.db")}), 2);
  EXPECT_EQ(sessionsIn(file("on/session.db")), 2U);
  EXPECT_EQ(call({"map", file("in12"), "--out", file("on"), "--stages", "vo"}), 2) << "it holds another recording too";
  ASSERT_EQ(call({"map", file("in12"), "--out", file("on"), "--stages", "vo", "--overwrite"}), 0);
  EXPECT_EQ(sessionsIn(file("on/session.db")), 1U) << "without --store a folder's store is this run's";
}

TEST_F(StoreCommands, MapRelaxesTheSessionsOfAStoreWithNewOnes) {
  // Closures between frames, from the truth of rooms that both folders show.
  const auto truth = [&](const std::string& name) { return urban_nav_core::readKitti(file(name + "/poses.txt")); };
  const std::string header =
      "session_a,stamp_a_ns,session_b,stamp_b_ns,probability,kind,x,y,z,qx,qy,qz,qw,sigma_m,sigma_rad\n";
  const auto toRow = [&](const std::string& a, int i, const std::string& b, int j) {
    const Pose T_base_camera = urban_nav_ros::opticalInBody();
    const Pose T = T_base_camera * truth(a).at(i).inverse() * truth(b).at(j) * T_base_camera.inverse();
    std::string row =
        a + "," + std::to_string(i * 50'000'000LL) + "," + b + "," + std::to_string(j * 50'000'000LL) + ",0.9,stereo";
    for (const double v : {T.t().x(), T.t().y(), T.t().z(), T.q().x(), T.q().y(), T.q().z(), T.q().w(), 0.001, 0.001})
      row += "," + urban_nav_core::printNumber(v);
    return row + "\n";
  };
  const std::string within = toRow("in16", 0, "in16", 12) + toRow("in16", 2, "in16", 15) + toRow("in16", 1, "in16", 14);
  const std::string between = toRow("in16", 3, "in12", 1) + toRow("in16", 9, "in12", 7) + toRow("in16", 14, "in12", 11);
  urban_nav_input::testing::writeFile(file("within.csv"), header + within);
  urban_nav_input::testing::writeFile(file("between.csv"), header + between);
  urban_nav_input::testing::writeFile(file("all.csv"), header + between + within);
  ASSERT_EQ(call({"map", file("in16"), file("in12"), "--out", file("at_once"), "--stages", "vo,graph", "--closures",
                  file("all.csv")}),
            0);
  ASSERT_EQ(
      call({"map", file("in16"), "--out", file("day1"), "--stages", "vo,graph", "--closures", file("within.csv")}), 0);
  const std::string day1 = dumpStore(file("day1/session.db"));
  for (const char* closures : {"between.csv", "all.csv"}) {
    const std::string out = file(std::string("day2") + closures);
    ASSERT_EQ(call({"map", file("in12"), "--out", out, "--stages", "vo,graph", "--closures", file(closures), "--store",
                    file("day1/session.db")}),
              0);
    for (const char* name :
         {"trajectory.tum", "trajectory.kitti", "covariance.csv", "relative_covariance.csv", "graph.g2o"})
      EXPECT_TRUE(readFile(out + "/" + name) == readFile(file(std::string("at_once/") + name)))
          << name << ", " << closures;
    EXPECT_EQ(urban_nav_core::parseClosures(readFile(out + "/closures.csv"), "").size(), 6U);
    EXPECT_TRUE(readFile(out + "/trajectory_2.tum").empty()) << "it joined";
    const auto joined = [&](const std::string& db) { return readStoreInfo(db).joined; };
    EXPECT_EQ(joined(out + "/session.db").size(), joined(file("at_once/session.db")).size());
  }
  EXPECT_TRUE(dumpStore(file("day1/session.db")) == day1) << "it is only read";
  const std::string lines = readFile(file("at_once/trajectory.tum"));
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 28) << "of both";

  // In the folder of the store itself; a cut-off run would find it so and go on.
  ASSERT_EQ(call({"map", file("in12"), "--out", file("day1"), "--stages", "vo,graph", "--closures", file("between.csv"),
                  "--store", file("day1/session.db")}),
            0);
  EXPECT_TRUE(readFile(file("day1/trajectory.tum")) == readFile(file("at_once/trajectory.tum")));
  EXPECT_TRUE(readFile(file("day1/closures.csv")) == readFile(file("day2between.csv/closures.csv")));
  // Nothing new: the closures of the store are there still.
  ASSERT_EQ(call({"map", file("in12"), "--out", file("alone"), "--store", file("day1/session.db")}), 0);
  const bool first = readStoreInfo(file("alone/session.db")).sessions.front().session.name == "in12";  // by its id
  const std::string own = first ? "alone/trajectory.tum" : "alone/trajectory_2.tum";
  const std::string other = first ? "alone/trajectory_2.tum" : "alone/trajectory.tum";
  const auto alone = urban_nav_core::readTum(file(own)), odometry = urban_nav_core::readTum(file("b/trajectory.tum"));
  ASSERT_EQ(alone.size(), odometry.size()) << "mapped again, without what joined it";
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_TRUE(isApprox(alone[i].pose, odometry[i].pose, 1e-9));
  EXPECT_EQ(urban_nav_core::readTum(file(other)).size(), 16U);
}

TEST_F(StoreCommands, ExportRefusesByName) {
  const std::string store = file("a/session.db");
  EXPECT_EQ(call({"export", store}), 2);
  EXPECT_EQ(call({"export", store, "--las", file("x.las")}), 1) << "no lasers";
  EXPECT_EQ(call({"export", store, "--las", file("x.las"), "--crs", "auto"}), 1) << "no GPS";
  EXPECT_EQ(call({"export", store, "--ortho", file("x.jpg")}), 2);
  EXPECT_EQ(call({"export", store, "--grid", file("x.pgm")}), 2);
  EXPECT_EQ(call({"export", store, "--elevation", file("x.png")}), 2);
  EXPECT_EQ(call({"export", store, "--octomap", file("x.ot")}), 2);
  EXPECT_EQ(call({"export", store, "--geotiff", file("x.tif")}), 1) << "no lasers";
  EXPECT_EQ(call({"export", store, "--ply", file("x.ply"), "--crs", "auto"}), 2) << "PLY is in the frame map";
  EXPECT_EQ(call({"export", store, "--las", file("x.las"), "--crs", "UTM"}), 2);
  EXPECT_EQ(call({"export", store, "--las", file("x.las"), "--control", file("c.csv")}), 2) << "no system";
  EXPECT_EQ(call({"export", store, "--ortho", file("m.png"), "--grid", file("m.yaml"), "--crs", "auto"}), 2)
      << "one world file for two";
  EXPECT_EQ(call({"export", store, "--las", file("x.las"), "--control", file("c.csv"), "--crs", "auto"}), 2);
  EXPECT_EQ(call({"export", store, "--tum", file("x.tum"), "--session", "unknown"}), 2);
  EXPECT_EQ(call({"export", file("in16/times.txt"), "--tum", file("x.tum")}), 2);
  EXPECT_EQ(call({"export", file("nothing.db"), "--tum", file("x.tum")}), 2);
  urban_nav_input::testing::writeFile(file("damaged.db"), readFile(store).substr(0, 9000));
  EXPECT_EQ(call({"export", file("damaged.db"), "--tum", file("x.tum")}), 1);
  EXPECT_EQ(call({"info", file("damaged.db")}), 1);
}

TEST_F(StoreCommands, MergeGivesTheStoreOfOneRun) {
  ASSERT_EQ(
      call({"merge", file("a/session.db"), file("b/session.db"), "-o", file("merged.db"), "--json", file("m.json")}),
      0);
  const std::string whole = dumpStore(file("both/session.db")), merged = dumpStore(file("merged.db"));
  EXPECT_TRUE(whole == merged);
  EXPECT_NE(readFile(file("m.json")).find("\"rows\""), std::string::npos);
  EXPECT_EQ(call({"merge", file("a/session.db"), file("in16/times.txt"), "-o", file("m2.db")}), 2);
}

TEST_F(StoreCommands, RelaxedSessionsOfOneMapAreExportedTogether) {
  Store store(file("joined.db"), Access::Write);
  const Pose T_map_odom(urban_nav_core::Quaterniond::Identity(), {5.0, 0.0, 0.0});
  const auto at = [](double x) { return Pose(urban_nav_core::Quaterniond::Identity(), {x, 0.0, 0.0}); };
  const std::string one(16, '1'), two(16, '2');
  for (const auto& [id, start] : {std::pair{one, 0}, {two, 100}}) {
    store.sessions().put({id, "day " + id, "", "", start, true});
    for (int i = 0; i < 3; ++i) {
      urban_nav_store::Node node;
      node.stamp = start + i;
      node.T_odom_base = at(i);
      store.graph().put(id, node);
    }
  }
  store.graph().put(one, urban_nav_store::RelaxedPose{0, at(0.5), 1});
  store.graph().put(one, urban_nav_store::RelaxedPose{1, at(2.0), 1});
  store.sessions().put(urban_nav_store::Anchor{two, one, 1, T_map_odom});
  Edge edge{{one, 1},
            {two, 100},
            EdgeKind::Stereo,
            "x",
            {at(3.0), urban_nav_core::Matrix6d::Identity()},
            1.0,
            ClosureVerdict::Accepted,
            ""};
  store.graph().put(edge);
  edge.kind = EdgeKind::Icp;
  edge.verdict = ClosureVerdict::Rejected;
  store.graph().put(edge);
  edge.kind = EdgeKind::Session;
  edge.verdict = ClosureVerdict::Accepted;
  store.graph().put(edge);
  const auto maps = readMaps(store, selectSessions(store, {}));
  ASSERT_EQ(maps.size(), 1U);
  const urban_nav_core::Trajectory trajectory = urban_nav_core::parseTum(exportTum(store, maps[0]), "x");
  std::vector<double> x;
  for (const auto& pose : trajectory) x.push_back(pose.pose.t().x());
  EXPECT_EQ(x, (std::vector<double>{0.5, 2.0, 3.0, 5.0, 6.0, 7.0})) << "the third goes with the second";
  const ExportedGraph graph = exportG2o(store, maps);
  EXPECT_EQ(graph.vertices, 6);
  EXPECT_EQ(graph.edges, 1);
  EXPECT_EQ(graph.left_out, 1);
  EXPECT_EQ(graph.outside, 0);
  EXPECT_EQ(exportG2o(store, readMaps(store, selectSessions(store, {one}))).outside, 2) << "both to the other session";
  EXPECT_EQ(urban_nav_core::parseG2o(graph.text, "x").edges.front().to, 3);
  store.commit();
  store.close();
  const StoreInfo info = readStoreInfo(file("joined.db"));
  EXPECT_EQ(info.joined.size(), 1U);
  EXPECT_NE(toText(info).find("joined by closures"), std::string::npos);
}

TEST_F(StoreCommands, PlacesAreExportedWithPosesThumbnailsAndModel) {
  const std::string one = "00112233445566778899", model = "0123456789abcdef";
  Store store(file("places.db"), Access::Write);
  store.sessions().put({one, "monday", "", "", 0, true});
  for (int i = 0; i < 2; ++i) {
    urban_nav_store::Node node;
    node.stamp = 100 * i;
    node.T_odom_base = Pose(urban_nav_core::Quaterniond::Identity(), {2.0 * i, 0.0, 0.0});
    store.graph().put(one, node);
  }
  urban_nav_store::TableStore<urban_nav_store::StoredPlace> rows(store);
  for (const std::int64_t stamp : {50, 900}) {
    urban_nav_store::StoredPlace row;
    row.session = one;
    row.stamp = stamp;
    row.status = "used";
    row.model = model;
    row.thumbnail = stamp == 50 ? "jpeg" : "";
    rows.put(row);
  }
  urban_nav_store::TableStore<urban_nav_store::StoredModel>(store).put({one, model, "fabmap_node", "bytes"});
  store.commit();
  const ExportedPlaces made = exportPlaces(store, readMaps(store, selectSessions(store, {})), file("exported"));
  EXPECT_EQ(made.places, 2);
  EXPECT_EQ(made.thumbnails, 1);
  const auto table = urban_nav_core::CsvTable::read(file("exported/places.csv"));
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_DOUBLE_EQ(table.number(0, table.column("x")), 1.0) << "between its neighbours in time";
  EXPECT_EQ(table.text(1, table.column("x")), "") << "after the trajectory";
  EXPECT_EQ(readFile(file("exported/" + table.text(0, table.column("thumbnail")))), "jpeg");
  EXPECT_EQ(readFile(file("exported/" + model + ".places")), "bytes");
  EXPECT_EQ(call({"export", file("a/session.db"), "--places", file("none")}), 1) << "a map without places";
}

/// Ids of sessions and hashes of models become names of files.
TEST_F(StoreCommands, IdsThatAreNoHexadecimalDigitsAreRefusedBeforeAnythingIsWritten) {
  const std::string id = "00112233445566778899", hash = "0123456789abcdef";
  for (const auto& [session, model] :
       {std::pair{std::string("../../escaped_session"), hash}, std::pair{std::string("/tmp/escaped_session"), hash},
        std::pair{id, std::string("../../escaped_model")}, std::pair{id, std::string("0123456789abcde")},
        std::pair{id, std::string("0123456789ABCDEF")}}) {
    std::filesystem::remove_all(file("inner"));
    const std::string path = file("inner/doctored.db"), out = file("inner/deeper/out");
    std::filesystem::create_directories(file("inner/deeper"));
    Store store(path, Access::Write);
    store.sessions().put({session, "monday", "", "", 0, true});
    urban_nav_store::Node node;
    store.graph().put(session, node);
    urban_nav_store::StoredPlace row;
    row.session = session;
    row.status = "used";
    row.model = model;
    row.thumbnail = "jpeg";
    urban_nav_store::TableStore<urban_nav_store::StoredPlace>(store).put(row);
    urban_nav_store::TableStore<urban_nav_store::StoredModel>(store).put({session, model, "fabmap_node", "bytes"});
    store.commit();
    store.close();
    EXPECT_EQ(call({"export", path, "--places", out}), 1) << session << " " << model;
    EXPECT_EQ(call({"info", path}), 1) << session << " " << model;
    std::set<std::string> files;
    for (const auto& each : std::filesystem::recursive_directory_iterator(file("inner")))
      files.insert(each.path().filename().string());
    EXPECT_EQ(files, (std::set<std::string>{"doctored.db", "deeper"}));
    EXPECT_FALSE(std::filesystem::exists("/tmp/escaped_session_0.jpg"));
  }
}

}  // namespace
}  // namespace urban_nav
