// SPDX-License-Identifier: BSD-3-Clause
#include "file/information.hpp"

#include <algorithm>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

namespace {

// Tolerance relative to the largest eigenvalue. A number of six digits has a relative error of at most 5e-6, a matrix
// of six rows up to six times that of its largest entry.
constexpr double kSixDigits = 3e-5;
constexpr double kDoubleRoundOff = 1e-9;  // below it no correction is needed: no square root is taken

template <int N>
bool isSemidefinite(const Eigen::Matrix<double, N, N>& information) {
  if constexpr (N == 1) {
    return information(0, 0) >= 0.0;
  } else {
    // Most matrices pass the Cholesky test, which takes a tenth of the time of eigenvalues.
    if (urban_nav_core::SmallCholesky<N>(information).succeeded()) return true;
    const auto values = urban_nav_core::symmetricEigenvalues(information);
    return values && (*values)[0] >= -kSixDigits * std::max(0.0, values->maxCoeff());
  }
}

template <int N>
void clampEigenvalues(Eigen::Matrix<double, N, N>& information) {
  if (urban_nav_core::SmallCholesky<N>(information).succeeded()) return;
  const auto eigen = urban_nav_core::smallEigen<N>(information);
  if (eigen.values[0] >= -kDoubleRoundOff * eigen.values[N - 1]) return;
  const Eigen::Matrix<double, N, 1> clamped = eigen.values.cwiseMax(0.0);
  const Eigen::Matrix<double, N, N> made = eigen.vectors * clamped.asDiagonal() * eigen.vectors.transpose();
  information = 0.5 * (made + made.transpose());
}

}  // namespace

template <int D>
TangentMatrix<D> tangentInformation(const std::array<double, 21>& upper_triangle) {
  urban_nav_core::G2oGraph::Edge edge;
  edge.information = upper_triangle;
  TangentMatrix<D> information = urban_nav_core::g2oInformation(edge, D);
  if constexpr (D == 3) {
    information.template topRightCorner<3, 3>() *= 0.5;
    information.template bottomLeftCorner<3, 3>() *= 0.5;
    information.template bottomRightCorner<3, 3>() *= 0.25;
  }
  return information;
}

template <int D>
bool demandSemidefinite(Semidefinite demanded, TangentMatrix<D>& information, const std::string& what,
                        const std::string& name) {
  if (isSemidefinite<kTangentSize<D>>(information)) {
    clampEigenvalues<kTangentSize<D>>(information);
    return true;
  }
  constexpr int kR = kTangentSize<D> - D;
  if (demanded == Semidefinite::Blocks && isSemidefinite<D>(information.template topLeftCorner<D, D>()) &&
      isSemidefinite<kR>(information.template bottomRightCorner<kR, kR>()))
    return false;
  throw urban_nav_core::UserError(name, "the information of " + what + " has a negative eigenvalue",
                                  "positive semidefinite matrices");
}

template TangentMatrix<2> tangentInformation<2>(const std::array<double, 21>&);
template TangentMatrix<3> tangentInformation<3>(const std::array<double, 21>&);
template bool demandSemidefinite<2>(Semidefinite, TangentMatrix<2>&, const std::string&, const std::string&);
template bool demandSemidefinite<3>(Semidefinite, TangentMatrix<3>&, const std::string&, const std::string&);

}  // namespace pose_graph
