// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>

#include "base/parameters.hpp"
#include "commands/stages.hpp"
#include "map/map_pipeline.hpp"
#include "topics/loops/explanation.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/io/closures_csv.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureRow;
using urban_nav_core::Pose;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_input::testing::writeFile;

constexpr const char* kHeader = "session_a,stamp_a_ns,session_b,stamp_b_ns,probability\n";

void map(const std::vector<std::string>& inputs, const std::string& out, const std::string& closures,
         const std::function<void(MapOptions&)>& change = {}) {
  MapOptions request{
      inputs, out, {"vo", "loops", "graph"}, "", closures, "", {}, loadParameters(Arguments({}, addStageTables)), 1};
  request.parameters.set("registration.keyframe_distance=0.05");  // the robot of the room drives a few decimetres
  if (change) change(request);
  Console console;
  runMap(request, makeStages(), console);
}

/// Two sessions in the same room, whose frames differ by a known transform.
class Loops : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    urban_nav_input::testing::makeKittiFolder(file("monday"));
    urban_nav_input::testing::KittiStyle shorter;  // another recording: the same one twice would be one session
    shorter.frames = 15;
    urban_nav_input::testing::makeKittiFolder(file("tuesday"), shorter);
    writeFile(file("closures.csv"), std::string(kHeader) + "0,200000000,1,400000000,0.9\n" +
                                        "monday,500000000,tuesday,100000000,0.8\n" +
                                        "monday,0,tuesday,900000000000,0.7\n" + "monday,0,sunday,0,0.6\n");
    map({file("monday"), file("tuesday")}, file("out"), file("closures.csv"));
  }
  static void TearDownTestSuite() { shared_.reset(); }
  static std::string file(const std::string& name) { return shared_->file(name); }
  static std::vector<ClosureRow> listRows(const std::string& out) {
    return urban_nav_core::readClosures(file(out) + "/closures.csv");
  }

 private:
  static std::unique_ptr<TemporaryFolder> shared_;
};
std::unique_ptr<TemporaryFolder> Loops::shared_;

TEST_F(Loops, FindsTheTransformsOfTrueClosuresAndJoinsTheSessions) {
  const std::vector<ClosureRow> rows = listRows("out");
  ASSERT_EQ(rows.size(), 4U);
  const std::vector<Pose> truth = urban_nav_core::readKitti(file("monday") + "/poses.txt");
  // base_link is the left camera with its axes turned.
  const Pose T_base_camera((urban_nav_core::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished(),
                           urban_nav_core::Vector3d::Zero());
  for (const auto& [row, a, b] : {std::make_tuple(1, 4, 8), std::make_tuple(0, 10, 2)}) {
    const ClosureRow& closure = rows[static_cast<std::size_t>(row)];
    EXPECT_EQ(closure.method, ClosureMethod::Stereo);
    ASSERT_TRUE(closure.T_a_b) << closure.reason;
    const Pose expected = T_base_camera * truth[static_cast<std::size_t>(a)].inverse() *
                          truth[static_cast<std::size_t>(b)] * T_base_camera.inverse();
    EXPECT_LT(distanceBetween(*closure.T_a_b, expected), 0.03);
    EXPECT_LT(angleBetween(*closure.T_a_b, expected), 0.0035);
  }
  const std::string summary = readFile(file("out") + "/summary.json");
  for (const char* text : {"\"candidates\": 4", "\"accepted_stereo\": 2", "\"accepted_icp\": 0", "\"rejected\": 2",
                           "\"sessions_joined\": 2"})
    EXPECT_NE(summary.find(text), std::string::npos) << text;
}

TEST_F(Loops, NamesWhyTheOthersHaveNone) {
  const std::string text = readFile(file("out") + "/closures.csv");
  EXPECT_NE(text.find("unknown_moment: no frames around 900.000000000 s in tuesday"), std::string::npos) << text;
  EXPECT_NE(text.find("no session \"\"sunday\"\" in this map; there are: monday, tuesday"), std::string::npos) << text;
}

TEST_F(Loops, GivesTheSameBytesWithTwoThreads) {
  map({file("monday"), file("tuesday")}, file("threads"), file("closures.csv"),
      [](MapOptions& request) { request.threads = 2; });
  for (const char* name : {"trajectory.tum", "covariance.csv", "closures.csv", "graph.g2o"})
    EXPECT_EQ(readFile(file("out") + "/" + name), readFile(file("threads") + "/" + name)) << name;
}

TEST_F(Loops, LaterDaysFindTheViewsOfEarlierOnesInTheStore) {
  map({file("monday")}, file("first"), "");
  map({file("tuesday")}, file("second"), file("closures.csv"),
      [](MapOptions& request) { request.store = file("first") + "/session.db"; });
  const std::vector<ClosureRow> rows = listRows("second");
  ASSERT_EQ(rows.size(), 4U);
  ASSERT_EQ(rows[0].b.stamp, 100'000'000) << "closures are in the order of time";
  ASSERT_EQ(rows[0].method, ClosureMethod::Stereo) << readFile(file("second") + "/closures.csv");
  EXPECT_EQ(rows[0].T_a_b->matrix(), listRows("out")[0].T_a_b->matrix());
}

TEST_F(Loops, WhyPrintsTheEvidenceOfTheStore) {
  urban_nav_store::Store store(file("out") + "/session.db", urban_nav_store::Access::Read);
  const std::vector<StoredClosure> closures = listClosures(store);
  ASSERT_EQ(closures.size(), 3U) << "the one with an unknown session has no place in a store";
  EXPECT_LT(computeDistance(closures[0], parseTimeQuery("monday+0.2", ""), parseTimeQuery("tuesday+0.4", "")), 1e-6);
  EXPECT_LT(computeDistance(closures[0], parseTimeQuery("0.4", ""), parseTimeQuery("0.2", "")), 1e-6);
  EXPECT_GT(computeDistance(closures[0], parseTimeQuery("tuesday+0.2", ""), parseTimeQuery("tuesday+0.4", "")), 1e6);
  const std::string text = explain(closures[0]);
  for (const char* part : {"accepted, by stereo", "passed  matches", "Two views: accepted", "distance_m"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
  const Page page = explainOnPage(closures[0], store, urban_nav_registration::Parameters().cloud_half_length);
  ASSERT_FALSE(page.sections.empty());
  EXPECT_EQ(page.sections[0].pictures.size(), 1U);
}

TEST_F(Loops, AnotherDayIsFoundInAMapThatStaysAsItIs) {
  map({file("monday")}, file("frozen"), "");
  const std::string before = readFile(file("frozen") + "/session.db");
  map({file("tuesday")}, file("found"), "", [](MapOptions& request) {
    request.stages.clear();
    request.localise = file("frozen") + "/session.db";
  });
  EXPECT_EQ(readFile(file("frozen") + "/session.db"), before);
  EXPECT_EQ(std::filesystem::exists(file("frozen") + "/session.db-wal"), false);
  const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::read(file("found") + "/localisation.csv");
  ASSERT_EQ(table.rows(), 15U);
  // The same way through the same room, so that map and odometry of the second day are one. Less than half a metre of
  // it: one place, one witness, and so a right guess that is not KNOWN.
  const urban_nav_core::Trajectory truth = urban_nav_core::readTum(file("frozen") + "/trajectory.tum");
  EXPECT_EQ(table.text(14, table.column("knowledge")), "UNSURE");
  EXPECT_EQ(table.integer(14, table.column("witnesses")), 1);
  const auto number = [&](const char* name) { return table.number(14, table.column(name)); };
  EXPECT_LT((urban_nav_core::Vector3d(number("x"), number("y"), number("z")) - truth[14].pose.t()).norm(), 0.03);
  EXPECT_THROW(
      map({file("tuesday")}, file("nowhere"), "", [](MapOptions& request) { request.localise = file("closures.csv"); }),
      urban_nav_core::UserError);
}

TEST_F(Loops, WithoutTheStageTheTransformsOfTheFileCount) {
  writeFile(file("measured.csv"),
            "session_a,stamp_a_ns,session_b,stamp_b_ns,probability,x,y,z,qx,qy,qz,qw\n"
            "monday,200000000,tuesday,200000000,0.9,0,0,0,0,0,0,1\n");
  map({file("monday"), file("tuesday")}, file("given"), file("measured.csv"), [](MapOptions& request) {
    request.stages = {"vo", "graph"};
  });
  const std::vector<ClosureRow> rows = listRows("given");
  ASSERT_EQ(rows.size(), 1U);
  ASSERT_TRUE(rows[0].T_a_b);
  EXPECT_EQ(rows[0].T_a_b->t(), urban_nav_core::Vector3d::Zero());
  EXPECT_EQ(readFile(file("given") + "/summary.json").find("\"loop_metric\": {\n    \"candidates\""),
            std::string::npos);
}

}  // namespace
}  // namespace urban_nav
