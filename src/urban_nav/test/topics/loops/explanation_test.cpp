// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/explanation.hpp"

#include <gtest/gtest.h>

#include <string>

namespace urban_nav {
namespace {

StoredClosure closureWithoutEvidence(urban_nav_store::EdgeKind kind) {
  StoredClosure closure;
  closure.id = 1;
  closure.name_a = closure.name_b = "drive";
  closure.edge.kind = kind;
  closure.edge.verdict = urban_nav_core::ClosureVerdict::Accepted;
  closure.edge.measured.information = urban_nav_core::Matrix6d::Identity();
  return closure;
}

TEST(Explanation, ListsTheEvidenceOfConstraintsFromPlanes) {
  const std::string plane = explain(closureWithoutEvidence(urban_nav_store::EdgeKind::Plane));
  EXPECT_NE(plane.find("by plane"), std::string::npos) << plane;
  EXPECT_NE(plane.find("measured by the lasers in two passes"), std::string::npos) << plane;
  EXPECT_EQ(plane.find("no evidence"), std::string::npos) << plane;
  const std::string given = explain(closureWithoutEvidence(urban_nav_store::EdgeKind::Stereo));
  EXPECT_NE(given.find("The store has no evidence for it"), std::string::npos) << given;
}

}  // namespace
}  // namespace urban_nav
