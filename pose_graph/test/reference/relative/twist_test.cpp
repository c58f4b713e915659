// SPDX-License-Identifier: BSD-3-Clause
#include "relative/twist.hpp"

#include <gtest/gtest.h>

#include "small_graph.hpp"
#include "urban_nav_core/geometry/compose.hpp"

namespace pose_graph {
namespace {

using test::Draw;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

Pose corePose(const Rigid<3>& T) { return Pose(T.R, T.t); }

// Returns de / d(link) of an edge from m to q along a chain, as the product of both factors.
template <int D>
TangentMatrix<D> analytic(const Edge<D>& edge, const std::vector<Rigid<D>>& poses, int link) {
  const auto at = [&poses](int i) { return poses[static_cast<std::size_t>(i)]; };
  const double sign = edge.from < edge.to ? 1.0 : -1.0;
  return sign * edgeRow(edge, at(edge.from), at(edge.to)).K * linkMatrix<D>(at(link), at(link + 1).t);
}

template <int D>
void expectNumericDerivatives(bool backwards) {
  Draw<D> draw(3);
  constexpr double kFortyDegrees = 40.0 * M_PI / 180.0;
  std::vector<Rigid<D>> poses = {draw.rigid(20.0, 1.0)};
  for (int i = 0; i < 6; ++i) poses.push_back(poses.back() * draw.rigid(1.0, 0.5));
  const ChainState<D> state = makeState(poses);
  Problem<D> problem;
  problem.poses = poses;
  const Rigid<D> T = poses[1].inverse() * poses[5];
  Tangent<D> off = Tangent<D>::Zero();
  off[0] = 0.5;
  off[kTangentSize<D> - 1] = kFortyDegrees;
  const Rigid<D> Z = moved(T, off);
  problem.edges.push_back(backwards ? Edge<D>{5, 1, Z.inverse()} : Edge<D>{1, 5, Z});
  const Eigen::MatrixXd J = test::numericRows(problem, state);
  for (int link = 0; link < 6; ++link) {
    // (16): only blocks with m < k <= q are nonzero, here links 1...4.
    const bool inside = link >= 1 && link < 5;
    TangentMatrix<D> expected = TangentMatrix<D>::Zero();
    if (inside) expected = analytic(problem.edges[0], state.poses, link);
    const TangentMatrix<D> numeric = J.block<kTangentSize<D>, kTangentSize<D>>(0, kTangentSize<D> * link);
    EXPECT_LE((numeric - expected).norm(), 1e-8) << "link " << link;
    EXPECT_EQ(numeric.norm() > 0.1, inside) << "link " << link;
  }
}

TEST(Twist, TheRowsOfHAreNumericDerivativesAtLargeResiduals) {
  for (const bool backwards : {false, true}) {
    expectNumericDerivatives<2>(backwards);
    expectNumericDerivatives<3>(backwards);
  }
}

TEST(Twist, TheTwoFactorsAreTheProductOfEquation13) {
  Draw<3> draw(5);
  std::vector<Rigid<3>> poses = {draw.rigid(20.0, 1.0)};
  for (int i = 0; i < 6; ++i) poses.push_back(poses.back() * draw.rigid(1.0, 0.5));
  const Edge<3> edge{1, 5, moved(poses[1].inverse() * poses[5], draw.tangent(0.3, 0.3))};
  // The derivative of the residual with respect to the prediction T_m_q.
  const Rigid<3> T_m_q = poses[1].inverse() * poses[5];
  const Matrix6d by_prediction = edgeRow(edge, Rigid<3>(), T_m_q).K * linkMatrix<3>(Rigid<3>(), T_m_q.t);
  for (int r = 2; r <= 5; ++r) {
    const auto at = [&poses](int i) { return corePose(poses[static_cast<std::size_t>(i)]); };
    const Pose T_m_before = at(1).inverse() * at(r - 1), v = at(r - 1).inverse() * at(r),
               T_r_q = at(r).inverse() * at(5);
    const Matrix6d J1 = urban_nav_core::compose(T_m_before * v, T_r_q).J1;
    const Matrix6d J2 = urban_nav_core::compose(T_m_before, v).J2;
    EXPECT_LE((by_prediction * J1 * J2 - analytic(edge, poses, r - 1)).norm(), 1e-12) << "v_" << r;
  }
}

template <int D>
void expectForceIsTransposed() {
  Draw<D> draw(7);
  const Rigid<D> previous = draw.rigid(5.0, 1.0);
  const Vector<D> p = draw.rigid(5.0, 1.0).t;
  const Tangent<D> d = draw.tangent(1.0, 1.0), z = draw.tangent(1.0, 1.0);
  EXPECT_NEAR(linkTwist<D>(previous, p, d).dot(z), d.dot(linkForce<D>(previous, p, z)), 1e-13);
  EXPECT_LE((linkMatrix<D>(previous, p) * d - linkTwist<D>(previous, p, d)).norm(), 1e-13);
}

TEST(Twist, ForceIsTheTransposedMap) {
  expectForceIsTransposed<2>();
  expectForceIsTransposed<3>();
}

TEST(Twist, AThousandTurnsStayARotation) {
  const Rigid<3> turn = Draw<3>(9).rigid(1.0, 1.0);
  Rigid<3> T;
  for (int i = 0; i < 100000; ++i) T = chained(T, turn);
  EXPECT_LE((T.R * T.R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  Rigid<2> flat;
  for (int i = 0; i < 100000; ++i) flat = chained(flat, Draw<2>(9).rigid(1.0, 1.0));
  EXPECT_LE((flat.R * flat.R.transpose() - Eigen::Matrix2d::Identity()).norm(), 1e-15);
}

}  // namespace
}  // namespace pose_graph
