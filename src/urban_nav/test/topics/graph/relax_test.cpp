// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "base/command.hpp"
#include "commands/stages.hpp"
#include "topics/graph/graph.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/toro.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::G2oGraph;
using urban_nav_core::Pose;
using urban_nav_core::readTextFile;
using urban_nav_core::writeAtomically;

class Relax : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }
  int relax(std::vector<std::string> words) const {
    words.insert(words.begin(), {"urban_nav", "relax"});
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    return runCommandLine({relaxCommand()}, addStageTables, static_cast<int>(argv.size()), argv.data());
  }
  G2oGraph read(const std::string& name) const {
    const std::string text = readTextFile(path(name));
    return urban_nav_core::isToro(text) ? urban_nav_core::parseToro(text, name) : urban_nav_core::parseG2o(text, name);
  }

 private:
  const urban_nav_input::testing::TemporaryFolder folder_;
};

// A square whose odometry turns too little, and a closure that contradicts it.
const char* const kSquare =
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 1.5\nVERTEX_SE2 2 1 1 3\nVERTEX_SE2 3 0 1 -1.7\nVERTEX_SE2 4 0.1 0.1 0.1\n"
    "EDGE_SE2 0 1 1 0 1.5 100 0 0 100 0 400\nEDGE_SE2 1 2 1 0 1.5 100 0 0 100 0 400\n"
    "EDGE_SE2 2 3 1 0 1.5 100 0 0 100 0 400\nEDGE_SE2 3 4 1 0 1.5 100 0 0 100 0 400\n"
    "EDGE_SE2 4 0 0 0 0 100 0 0 100 0 400\n";

void expectSamePoses(const G2oGraph& a, const G2oGraph& b, double tolerance) {
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    EXPECT_TRUE(isApprox(a.pose(a.vertices[i]), b.pose(b.vertices[i]), tolerance)) << i;
}

TEST_F(Relax, ThePapersSolverEndsWhereTheDefaultOneDoes) {
  writeAtomically(path("in.g2o"), kSquare);
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--robust", "off"}), 0);
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("b.g2o"), "--robust", "off", "--solver", "relative_pcg"}), 0);
  const G2oGraph a = read("a.g2o");
  expectSamePoses(a, read("b.g2o"), 1e-4);
  EXPECT_FALSE(isApprox(a.pose(a.vertices[4]), read("in.g2o").pose(a.vertices[4]).inverse(), 0.01)) << "it moved";
  EXPECT_EQ(relax({path("in.g2o"), "-o", path("c.g2o"), "--solver", "relative_pcg", "--objective", "g2o"}), 2);
  EXPECT_FALSE(std::filesystem::exists(path("c.g2o")));
}

TEST_F(Relax, CeresEndsWhereTheDefaultOneDoes) {
  writeAtomically(path("in.g2o"), kSquare);
  for (const char* objective : {"geodesic", "chordal", "g2o"}) {
    ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--objective", objective}), 0);
    ASSERT_EQ(relax({path("in.g2o"), "-o", path("b.g2o"), "--objective", objective, "--solver", "ceres"}), 0);
    expectSamePoses(read("a.g2o"), read("b.g2o"), 1e-4);
  }
}

TEST_F(Relax, ChordalOptimaAreCertified) {
  writeAtomically(path("in.g2o"), kSquare);
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--objective", "chordal", "--json", path("a.json")}), 0);
  EXPECT_NE(readTextFile(path("a.json")).find("\"certified\": true"), std::string::npos)
      << readTextFile(path("a.json"));
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--json", path("a.json")}), 0);
  EXPECT_EQ(readTextFile(path("a.json")).find("certified"), std::string::npos);
}

TEST_F(Relax, CeresHoldsFixedVerticesAndPriorsToo) {
  writeAtomically(path("in.g2o"), std::string(kSquare) + "FIX 1 3\nEDGE_PRIOR_SE2 4 0.2 0 0.1 50 0 0 50 0 90\n");
  for (const char* objective : {"geodesic", "chordal", "g2o"}) {
    ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--objective", objective, "--robust", "off"}), 0);
    ASSERT_EQ(
        relax({path("in.g2o"), "-o", path("b.g2o"), "--objective", objective, "--robust", "off", "--solver", "ceres"}),
        0);
    const G2oGraph in = read("in.g2o"), a = read("a.g2o");
    expectSamePoses(a, read("b.g2o"), 1e-4);
    EXPECT_EQ(a.vertices[1].values, in.vertices[1].values);
    EXPECT_EQ(a.vertices[3].values, in.vertices[3].values);
  }
  EXPECT_EQ(relax({path("in.g2o"), "-o", path("c.g2o"), "--solver", "relative_pcg"}), 2);
}

TEST_F(Relax, AnEndAtTheLimitIsAWarningThatStatesTheGradient) {
  writeAtomically(path("in.g2o"), kSquare);
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--robust", "off", "--start", "odometry", "--set",
                   "pose_graph.iterations=1", "--json", path("a.json")}),
            0);
  const std::string json = readTextFile(path("a.json"));
  EXPECT_NE(json.find("\"ending\": \"iterations\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"gradient\": "), std::string::npos) << json;
  EXPECT_NE(json.find("ended after 1 iterations before it reached the minimum: the gradient of the cost is"),
            std::string::npos)
      << json;
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("b.g2o"), "--robust", "off", "--json", path("b.json")}), 0);
  EXPECT_EQ(readTextFile(path("b.json")).find("gradient"), std::string::npos);
}

TEST_F(Relax, ToroGoesInAndOut) {
  writeAtomically(path("in.g2o"), kSquare);
  urban_nav_core::writeToro(path("in.graph"), read("in.g2o"));
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o")}), 0);
  ASSERT_EQ(relax({path("in.graph"), "-o", path("b.toro")}), 0);
  EXPECT_EQ(readTextFile(path("b.toro")).substr(0, 8), "VERTEX2 ");
  expectSamePoses(read("a.g2o"), read("b.toro"), 1e-12);
  ASSERT_EQ(relax({path("in.graph"), "-o", path("c.g2o")}), 0);
  EXPECT_EQ(readTextFile(path("c.g2o")), readTextFile(path("a.g2o")));
}

TEST_F(Relax, UnknownLinesAreRefusedOrNamedAndCounted) {
  writeAtomically(path("in.g2o"),
                  std::string(kSquare) + "TUTORIAL_EDGE_SE2 4 0 1 0 0 1\nTUTORIAL_EDGE_SE2 4 1 1 0 0 1\n");
  EXPECT_EQ(relax({path("in.g2o"), "-o", path("a.g2o")}), 2);
  EXPECT_FALSE(std::filesystem::exists(path("a.g2o")));
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--ignore-unknown", "--json", path("a.json")}), 0);
  EXPECT_NE(readTextFile(path("a.json")).find("2 lines TUTORIAL_EDGE_SE2"), std::string::npos);
}

// A square measured accurately enough that a true closure is more likely than chance by a factor above 1000.
const char* const kSharpSquare =
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 1.57\nVERTEX_SE2 2 1 1 3.14\nVERTEX_SE2 3 0 1 -1.57\nVERTEX_SE2 4 0 0 0\n"
    "EDGE_SE2 0 1 1 0 1.57 1e4 0 0 1e4 0 4e4\nEDGE_SE2 1 2 1 0 1.57 1e4 0 0 1e4 0 4e4\n"
    "EDGE_SE2 2 3 1 0 1.57 1e4 0 0 1e4 0 4e4\nEDGE_SE2 3 4 1 0 1.57 1e4 0 0 1e4 0 4e4\n"
    "EDGE_SE2 4 0 0 0 0 1e4 0 0 1e4 0 4e4\n";

TEST_F(Relax, AnUndecidedSelectionIsOdometryAndReported) {
  writeAtomically(path("in.g2o"), std::string(kSquare) + "EDGE_SE2 0 2 50 -30 1 100 0 0 100 0 400\n");
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--edges", path("e.csv"), "--json", path("a.json")}), 0);
  EXPECT_NE(readTextFile(path("e.csv")).find("4,0,0,rejected,"), std::string::npos);
  EXPECT_NE(readTextFile(path("a.json")).find("nothing could be decided"), std::string::npos);
  EXPECT_NE(readTextFile(path("a.json")).find("\"unknown\""), std::string::npos);
}

TEST_F(Relax, AFalsePriorIsRejectedAndNamed) {
  const std::string priors =
      "EDGE_PRIOR_SE2_XY 0 0 0 1e4 0 1e4\nEDGE_PRIOR_SE2_XY 1 1 0 1e4 0 1e4\nEDGE_PRIOR_SE2_XY 2 1 1 1e4 0 1e4\n"
      "EDGE_PRIOR_SE2_XY 4 0 0 1e4 0 1e4\n";
  writeAtomically(path("in.g2o"), kSharpSquare + priors + "EDGE_PRIOR_SE2_XY 3 50 -30 1e4 0 1e4\n");
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--edges", path("e.csv"), "--rejected", path("r.g2o"), "--json",
                   path("a.json")}),
            0);
  EXPECT_NE(readTextFile(path("e.csv")).find("\n3,,0,rejected,"), std::string::npos) << readTextFile(path("e.csv"));
  EXPECT_NE(readTextFile(path("a.json")).find("1 of 5 priors"), std::string::npos) << readTextFile(path("a.json"));
  EXPECT_EQ(readTextFile(path("r.g2o")).find("EDGE_PRIOR_SE2_XY 3 "), std::string::npos);
  writeAtomically(path("in.g2o"), kSharpSquare + priors);
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("b.g2o"), "--json", path("b.json")}), 0);
  EXPECT_NE(readTextFile(path("b.json")).find("\"warnings\": []"), std::string::npos) << readTextFile(path("b.json"));
  expectSamePoses(read("a.g2o"), read("b.g2o"), 1e-3);
}

TEST_F(Relax, CovariancesAndRejectedEdgesAreWritten) {
  writeAtomically(path("in.g2o"), std::string(kSharpSquare) + "EDGE_SE2 0 2 50 -30 1 1e4 0 0 1e4 0 4e4\n");
  ASSERT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--edges", path("e.csv"), "--covariance", path("c.csv"),
                   "--rejected", path("r.g2o")}),
            0);
  const std::string edges = readTextFile(path("e.csv")), covariances = readTextFile(path("c.csv"));
  EXPECT_EQ(edges.substr(0, edges.find('\n')), "from,to,weight,verdict,reason");
  EXPECT_NE(edges.find("0,2,0,rejected,"), std::string::npos) << edges;
  EXPECT_NE(edges.find("0,1,1,accepted,\n"), std::string::npos) << edges;
  EXPECT_EQ(read("r.g2o").edges.size(), 5U);
  EXPECT_EQ(read("r.g2o").vertices[4].values, read("in.g2o").vertices[4].values);
  EXPECT_EQ(std::count(covariances.begin(), covariances.end(), '\n'), 6);
  EXPECT_NE(covariances.find("\n0,0,0,0,0,0,0,0,0,0\n"), std::string::npos) << covariances;
}

TEST_F(Relax, ABrokenChainIsNamed) {
  std::string text = kSquare;
  text.erase(text.find("EDGE_SE2 2 3"), text.find("EDGE_SE2 3 4") - text.find("EDGE_SE2 2 3"));
  writeAtomically(path("in.g2o"), text);
  EXPECT_EQ(relax({path("in.g2o"), "-o", path("a.g2o"), "--solver", "relative_pcg"}), 2);
  EXPECT_EQ(relax({path("in.g2o"), "-o", path("a.g2o")}), 0);
}

}  // namespace
}  // namespace urban_nav
