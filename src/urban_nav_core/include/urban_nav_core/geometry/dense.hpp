// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace urban_nav_core {

/// Dense linear algebra of dynamic size as plain functions: the only place that instantiates factorisations, which
/// is where compile time goes. Matrices are column-major. The functions that say "in place" allocate nothing when they
/// are handed a matrix, a block of one, or a Map; any other expression would be copied by Eigen::Ref. The same numbers
/// in give the same bits out.
using MatrixRef = Eigen::Ref<Eigen::MatrixXd>;
using ConstMatrixRef = Eigen::Ref<const Eigen::MatrixXd>;

/// Cholesky in place: the lower triangle of A becomes L with A = L L^T; what is above the diagonal is neither read nor
/// written. False where A is not positive definite to working precision (A is then spoilt) or holds NaN.
bool choleskyInPlace(MatrixRef A);

/// B becomes L^-1 B, L^-T B, or B L^-T, reading the lower triangle of L.
void solveLowerInPlace(const ConstMatrixRef& L, MatrixRef B);
void solveLowerTransposedInPlace(const ConstMatrixRef& L, MatrixRef B);
void solveLowerTransposedFromRightInPlace(const ConstMatrixRef& L, MatrixRef B);

/// C becomes C - A A^T, lower triangle alone: what a Schur complement and a blocked factorisation are made of.
void subtractOuterInPlace(MatrixRef C, const ConstMatrixRef& A);

/// B becomes A^-1 B for a symmetric positive definite A, of which the lower triangle is read and spoilt. False as
/// choleskyInPlace; B is then as it was.
bool solvePositiveDefiniteInPlace(MatrixRef A, MatrixRef B);

/// Copies the lower triangle onto the upper one.
void mirrorLowerInPlace(MatrixRef A);

/// A^-1 of a symmetric positive definite A; empty where it is not. Allocates.
std::optional<Eigen::MatrixXd> invertPositiveDefinite(const ConstMatrixRef& A);

/// A^-1 B of a symmetric A of any signature, with pivoting; empty where A is singular to working precision. Allocates.
std::optional<Eigen::MatrixXd> solveSymmetric(const ConstMatrixRef& A, const ConstMatrixRef& B);

/// Eigenvalues, ascending, of a symmetric matrix (its lower triangle is read), with the unit eigenvectors in columns.
/// Empty where it holds NaN or infinities. Allocates.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
std::optional<SymmetricEigen> symmetricEigen(const ConstMatrixRef& A);
/// Eigenvalues alone; empty as above.
std::optional<Eigen::VectorXd> symmetricEigenvalues(const ConstMatrixRef& A);

/// Pseudo-inverse of a symmetric positive semi-definite matrix: eigenvalues below `relative_limit` times the largest
/// count as zero. Empty as above. Allocates.
std::optional<Eigen::MatrixXd> pseudoInverse(const ConstMatrixRef& A, double relative_limit);

}  // namespace urban_nav_core
