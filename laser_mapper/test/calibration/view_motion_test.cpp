// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/view_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace laser_mapper {
namespace {

using Eigen::Vector3d;
using urban_nav_core::Pose;

const Vector3d kHeadCentre(0.2, -0.1, 1.4), kSeenPoint(6.0, 3.0, 0.5);

/// Along a curve at constant twist, so that interpolated poses are exact.
urban_nav_core::Trajectory curve() {
  urban_nav_core::Trajectory path;
  urban_nav_core::Vector6d twist;
  twist << 1.3, 0.0, 0.1, 0.05, -0.02, 0.6;
  for (int i = 0; i < 200; ++i) path.append(i * 50'000'000LL, urban_nav_core::expSe3(0.05 * i * twist));
  return path;
}

MountedView sideView() {
  MountedView view;
  view.T_base_camera = Pose(urban_nav_core::expSo3(Vector3d(-1.2, 0.4, 0.9)), Vector3d(0.25, 0.0, 1.4));
  view.stamp = 4'025'000'000;
  return view;
}

TEST(ViewMotion, DerivativesAreThoseOfDifferencesFarFromZeroToo) {
  TermVector terms;
  terms << 0.04, 0.1, -0.2, 0.15, 0.3, -0.2, 0.5;
  const auto path = curve();
  const auto motion = viewMotionAt(sideView(), path, kHeadCentre, terms);
  ASSERT_TRUE(motion);
  const auto derivatives = motion->derivatives(kSeenPoint);
  for (int i = 0; i < kCalibrationTerms; ++i) {
    TermVector change = TermVector::Zero();
    change(i) = i == 0 ? 0.005 : 1e-5;
    const auto after = viewMotionAt(sideView(), path, kHeadCentre, changedTerms(terms, change)),
               before = viewMotionAt(sideView(), path, kHeadCentre, changedTerms(terms, -change));
    ASSERT_TRUE(after && before);
    const Vector3d difference =
        (after->R * kSeenPoint + after->t - before->R * kSeenPoint - before->t) / (2.0 * change(i));
    EXPECT_LT((difference - derivatives.col(i)).norm(), 1e-3) << i;
  }
}

TEST(ViewMotion, TheHeadTurnsAboutItsMiddle) {
  TermVector terms = TermVector::Zero();
  terms(6) = 0.1;
  const Pose correction = headCorrection(terms, kHeadCentre);
  EXPECT_LT((correction * kHeadCentre - kHeadCentre).norm(), 1e-12);
  terms(1) = 0.02;
  EXPECT_LT((headCorrection(terms, kHeadCentre) * kHeadCentre - kHeadCentre - Vector3d(0.02, 0.0, 0.0)).norm(), 1e-12);
}

TEST(ViewMotion, IsUnknownWhereThereAreNoPoses) {
  MountedView view = sideView();
  view.stamp = 20'000'000'000;
  EXPECT_FALSE(viewMotionAt(view, curve(), kHeadCentre, TermVector::Zero()));
}

}  // namespace
}  // namespace laser_mapper
