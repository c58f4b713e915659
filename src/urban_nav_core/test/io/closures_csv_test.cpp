// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/closures_csv.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr const char* kPrintedHeader =
    "session_a,stamp_a_ns,session_b,stamp_b_ns,probability,kind,verdict,reason,x,y,z,qx,qy,qz,qw,weight\n";

ClosureRow icpRow() {
  ClosureRow row;
  row.a = {"monday", 1225719873501685001};
  row.b = {"tuesday, after rain", -7};
  row.probability = 0.875;
  row.method = ClosureMethod::Icp;
  row.verdict = ClosureVerdict::Accepted;
  row.reason = "agrees, with all";
  row.T_a_b = Pose(Eigen::Quaterniond(0.6, 0.0, 0.8, 0.0), {1.0, -2.5, 0.1});
  row.weight = 0.75;
  return row;
}

/// Returns the message that parseClosures() refuses a text with; empty if it accepts it.
std::string closuresRefusal(const std::string& text) {
  try {
    parseClosures(text, "c.csv");
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

TEST(ClosuresCsvTest, PrintsWordsForEnumerators) {
  EXPECT_EQ(printClosures({icpRow()}),
            std::string(kPrintedHeader) +
                "monday,1225719873501685001,\"tuesday, after rain\",-7,0.875,icp,accepted,\"agrees, with all\","
                "1,-2.5,0.1,0,0.8,0,0.6,0.75\n");
  EXPECT_EQ(printClosures({ClosureRow()}), std::string(kPrintedHeader) + ",0,,0,1,none,,,,,,,,,,0\n");
}

TEST(ClosuresCsvTest, ReadsWhatItPrints) {
  const std::vector<ClosureRow> read = parseClosures(printClosures({icpRow(), ClosureRow()}), "c.csv");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].a, icpRow().a);
  EXPECT_EQ(read[0].b, icpRow().b);
  EXPECT_EQ(read[0].probability, 0.875);
  EXPECT_EQ(read[0].method, ClosureMethod::Icp);
  EXPECT_EQ(read[0].where, "c.csv:2");
  EXPECT_TRUE(isApprox(read[0].T_a_b.value(), *icpRow().T_a_b, 1e-15));
  EXPECT_FALSE(read[1].T_a_b);
  EXPECT_FALSE(read[0].verdict) << "verdicts of earlier runs are not read";
  EXPECT_EQ(read[0].reason, "");
  EXPECT_EQ(read[0].weight, 0.0);
}

TEST(ClosuresCsvTest, ReadsCandidatesAndStandardDeviations) {
  const std::vector<ClosureRow> candidates =
      parseClosures("session_a,stamp_a_ns,session_b,stamp_b_ns,probability\n0,5,1,7,0.5\n", "c.csv");
  ASSERT_EQ(candidates.size(), 1U);
  EXPECT_EQ(candidates[0].method, ClosureMethod::None);
  EXPECT_EQ(candidates[0].sigma_m, 0.0);
  const std::vector<ClosureRow> stated = parseClosures(
      "session_a,stamp_a_ns,session_b,stamp_b_ns,probability,kind,sigma_m,sigma_rad\n0,5,1,7,0.5,,0.25,0.05\n",
      "c.csv");
  EXPECT_EQ(stated.at(0).method, ClosureMethod::None);
  EXPECT_EQ(stated.at(0).sigma_m, 0.25);
  EXPECT_EQ(stated.at(0).sigma_rad, 0.05);
}

TEST(ClosuresCsvTest, NamesTheLineOfWhatItRefuses) {
  const std::string header = "session_a,stamp_a_ns,session_b,stamp_b_ns,probability,kind,x,y,z,qx,qy,qz,qw,sigma_m\n";
  EXPECT_EQ(closuresRefusal(header + "0,5,1,7,0.5,stereo,0,0,0,0,0,0,1,0.1\n"), "");
  for (const auto& [line, expected] : {std::pair("0,5,1,7,1.5,stereo,,,,,,,,", "probability = 1.5"),
                                       std::pair("0,5,1,7,0.5,lidar,,,,,,,,", "stereo, icp, none"),
                                       std::pair("0,5,1,7,0.5,accepted,,,,,,,,", "kind = accepted"),
                                       std::pair("0,5,1,7,0.5,icp,0,0,0,0,0,0,2,", "length 2"),
                                       std::pair("0,5,1,7,0.5,icp,0,0,0,0,0,0,1,-1", "sigma_m = -1")}) {
    const std::string message = closuresRefusal(header + line + "\n");
    EXPECT_NE(message.find("c.csv:2"), std::string::npos) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  }
  EXPECT_NE(closuresRefusal("session_a,stamp_a_ns\n0,1\n").find("session_b"), std::string::npos);
}

TEST(ClosuresCsvTest, FuzzedFilesAreReadOrRefused) {
  const auto result = testing::fuzzFile({printClosures({icpRow(), icpRow()}), printClosures({})}, "closures.csv",
                                        [](const std::string& path) { readClosures(path); });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

}  // namespace
}  // namespace urban_nav_core
