// SPDX-License-Identifier: BSD-3-Clause
#include "cholmod_once.hpp"

#include <suitesparse/cholmod.h>

#include <Eigen/SparseCore>
#include <vector>

#include "program.hpp"

namespace pose_graph::bench {

namespace {

/// Adjoint of SE(D). The Jacobians of an edge with zero residual are -Ad(Z^-1) and the identity.
template <int D>
TangentMatrix<D> adjoint(const Rigid<D>& T) {
  TangentMatrix<D> made = TangentMatrix<D>::Identity();
  made.template topLeftCorner<D, D>() = T.R;
  if constexpr (D == 2) {
    made(0, 2) = T.t.y(), made(1, 2) = -T.t.x();
  } else {
    Eigen::Matrix3d cross;
    cross << 0.0, -T.t.z(), T.t.y(), T.t.z(), 0.0, -T.t.x(), -T.t.y(), T.t.x(), 0.0;
    made.template bottomRightCorner<3, 3>() = T.R;
    made.template topRightCorner<3, 3>() = cross * T.R;
  }
  return made;
}

/// The upper triangle.
template <int D>
Eigen::SparseMatrix<double> gaussNewtonMatrix(const Problem<D>& problem) {
  constexpr int kN = kTangentSize<D>;
  std::vector<Eigen::Triplet<double>> entries;
  const auto put = [&](int i, int j, const TangentMatrix<D>& block) {
    for (int r = 0; r < kN && i > 0 && j > 0; ++r)
      for (int c = 0; c < kN; ++c)
        if ((i - 1) * kN + r <= (j - 1) * kN + c) entries.emplace_back((i - 1) * kN + r, (j - 1) * kN + c, block(r, c));
  };
  for (const Edge<D>& edge : problem.edges) {
    const TangentMatrix<D> J = -adjoint<D>(edge.Z.inverse()), JI = J.transpose() * edge.information;
    put(edge.from, edge.from, JI * J);
    put(edge.to, edge.to, edge.information);
    if (edge.from < edge.to) put(edge.from, edge.to, JI);
    else put(edge.to, edge.from, JI.transpose());
  }
  const int size = (static_cast<int>(problem.poses.size()) - 1) * kN;
  Eigen::SparseMatrix<double> made(size, size);
  made.setFromTriplets(entries.begin(), entries.end());
  made.makeCompressed();
  return made;
}

}  // namespace

template <int D>
double cholmodOnce(const Problem<D>& problem, int runs) {
  Eigen::SparseMatrix<double> matrix = gaussNewtonMatrix(problem);
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(matrix.rows());
  view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  view.p = matrix.outerIndexPtr(), view.i = matrix.innerIndexPtr(), view.x = matrix.valuePtr();
  view.stype = 1, view.itype = CHOLMOD_INT, view.xtype = CHOLMOD_REAL, view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  cholmod_common common;
  cholmod_start(&common);
  bool sound = true;
  const double seconds = measureSeconds(runs, [&] {
    cholmod_factor* factor = cholmod_analyze(&view, &common);
    sound = cholmod_factorize(&view, factor, &common) == 1 && common.status == CHOLMOD_OK && sound;
    cholmod_free_factor(&factor, &common);
  });
  cholmod_finish(&common);
  return sound ? seconds : -1.0;
}

template double cholmodOnce<2>(const Problem<2>&, int);
template double cholmodOnce<3>(const Problem<3>&, int);

}  // namespace pose_graph::bench
