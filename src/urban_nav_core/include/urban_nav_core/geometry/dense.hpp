// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace urban_nav_core {

/// Dense linear algebra of dynamic size as plain functions. Only dense.cpp instantiates these factorisations, which
/// limits compile time. Matrices are column-major. The in-place functions do not allocate when given a matrix, a block
/// of one, or a Map; Eigen::Ref copies any other expression. Results are bit-identical for identical input.
using MatrixRef = Eigen::Ref<Eigen::MatrixXd>;
using ConstMatrixRef = Eigen::Ref<const Eigen::MatrixXd>;

/// Cholesky decomposition A = L L^T, in place in the lower triangle of A; the strictly upper triangle is neither read
/// nor written. Returns false if A is not positive definite to working precision or contains NaN; A is then invalid.
bool choleskyInPlace(MatrixRef A);

/// Replace B by L^-1 B, L^-T B, or B L^-T, reading the lower triangle of L.
void solveLowerInPlace(const ConstMatrixRef& L, MatrixRef B);
void solveLowerTransposedInPlace(const ConstMatrixRef& L, MatrixRef B);
void solveLowerTransposedFromRightInPlace(const ConstMatrixRef& L, MatrixRef B);

/// Replaces the lower triangle of C by that of C - A A^T, as in Schur complements and blocked factorisations.
void subtractOuterInPlace(MatrixRef C, const ConstMatrixRef& A);

/// Replaces B by A^-1 B for a symmetric positive definite A. Reads and overwrites the lower triangle of A. Returns
/// false if A is not positive definite; B is then unchanged.
bool solvePositiveDefiniteInPlace(MatrixRef A, MatrixRef B);

/// Copies the lower triangle onto the upper one.
void mirrorLowerInPlace(MatrixRef A);

/// Returns A^-1 of a symmetric positive definite A; empty if A is not positive definite. Allocates.
std::optional<Eigen::MatrixXd> invertPositiveDefinite(const ConstMatrixRef& A);

/// Returns A^-1 B of a symmetric, possibly indefinite A, with pivoting; empty if A is singular to working precision.
/// Allocates.
std::optional<Eigen::MatrixXd> solveSymmetric(const ConstMatrixRef& A, const ConstMatrixRef& B);

/// Eigenvalues, ascending, of a symmetric matrix (its lower triangle is read), with unit eigenvectors in columns. Empty
/// if the matrix contains NaN or infinities. Allocates.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
std::optional<SymmetricEigen> symmetricEigen(const ConstMatrixRef& A);
/// Returns the eigenvalues without eigenvectors; empty if the matrix contains NaN or infinities. Allocates.
std::optional<Eigen::VectorXd> symmetricEigenvalues(const ConstMatrixRef& A);

/// Returns the pseudo-inverse of a symmetric positive semi-definite matrix; eigenvalues below `relative_limit` times
/// the largest count as zero. Empty if the matrix contains NaN or infinities. Allocates.
std::optional<Eigen::MatrixXd> pseudoInverse(const ConstMatrixRef& A, double relative_limit);

}  // namespace urban_nav_core
