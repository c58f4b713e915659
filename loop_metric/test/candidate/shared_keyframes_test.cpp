// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/candidate/shared_keyframes.hpp"

#include <gtest/gtest.h>

#include "loop_metric/evidence.hpp"
#include "urban_nav_core/types/error.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseRef;

Evidence::Try toTry(ClosureMethod method, const PoseRef& a, const PoseRef& b) {
  Evidence::Try result;
  result.method = method;
  result.keyframe_a = a;
  result.keyframe_b = b;
  return result;
}

/// A closure that was first tried with unsuitable keyframes, and then with those of `a` and `b`.
MetricClosure toClosure(const PoseRef& a, const PoseRef& b, ClosureMethod method = ClosureMethod::Stereo) {
  MetricClosure result;
  result.method = method;
  result.verdict = ClosureVerdict::Accepted;
  result.measured.information = 6.0 * Matrix6d::Identity();
  Evidence evidence;
  evidence.tries = {toTry(ClosureMethod::Stereo, {"day", 1}, {"day", 2}), toTry(ClosureMethod::Stereo, a, b)};
  result.evidence = printEvidence(evidence);
  return result;
}

double knows(const MetricClosure& closure) {
  EXPECT_EQ(closure.measured.information, closure.measured.information(0, 0) * Matrix6d::Identity());
  return closure.measured.information(0, 0);
}

TEST(SharedViews, OneMeasurementCountsOnceHoweverManyCandidatesItServes) {
  std::vector<MetricClosure> closures{toClosure({"day", 5}, {"day", 90}), toClosure({"day", 5}, {"day", 90}),
                                      toClosure({"day", 90}, {"day", 5}), toClosure({"day", 5}, {"day", 91}),
                                      toClosure({"day", 5}, {"next", 90})};
  discountSharedKeyframes(closures);
  for (int i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(knows(closures[static_cast<std::size_t>(i)]), 2.0);
  EXPECT_DOUBLE_EQ(knows(closures[3]), 6.0);
  EXPECT_DOUBLE_EQ(knows(closures[4]), 6.0);
}

TEST(SharedViews, OnlyAcceptedClosuresByStereoTakePart) {
  std::vector<MetricClosure> closures(4, toClosure({"day", 5}, {"day", 90}));
  closures[1].verdict = ClosureVerdict::Rejected;
  closures[2].method = ClosureMethod::Icp;
  closures[3].evidence.clear();
  EXPECT_FALSE(findKeyframes(closures[3]));
  discountSharedKeyframes(closures);
  for (const MetricClosure& closure : closures) EXPECT_DOUBLE_EQ(knows(closure), 6.0);
}

TEST(SharedViews, SequentiallyTheFirstHasAllInformation) {
  SharedKeyframeDiscount discount;
  double sum = 0.0;
  for (int i = 0; i < 20; ++i) {
    MetricClosure closure = toClosure({"day", 5}, {"day", 90});
    discount.discountAgainst(closure);
    EXPECT_GT(knows(closure), 0.0);
    sum += knows(closure);
  }
  EXPECT_NEAR(sum, 6.0, 0.06 * 6.0);
  MetricClosure other = toClosure({"day", 5}, {"day", 91}),
                clouds = toClosure({"day", 5}, {"day", 90}, ClosureMethod::Icp);
  discount.discountAgainst(other);
  discount.discountAgainst(clouds);
  EXPECT_DOUBLE_EQ(knows(other), 6.0);
  EXPECT_DOUBLE_EQ(knows(clouds), 6.0);
}

TEST(SharedViews, DamagedEvidenceIsNamed) {
  MetricClosure closure = toClosure({"day", 5}, {"day", 90});
  closure.evidence = closure.evidence.substr(0, closure.evidence.size() / 2) + "\nnonsense";
  EXPECT_THROW(findKeyframes(closure), urban_nav_core::DataError);
}

}  // namespace
}  // namespace loop_metric
