// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace urban_nav_core::kernels {

/// The inner loops of the dense Cholesky, own code because Eigen compiled for the portable baseline reaches a quarter
/// of the processor: chosen at run time by what it can do. Each sum runs in the same order and nothing is fused, so the
/// bits do not depend on that choice.
///
/// A strip of 8 rows and `depth` columns is packed as depth groups of 8 numbers; strips follow one another.
constexpr int kStrip = 8;

struct InstructionSet {
  const char* name;

  /// C -= X X^T for the matrix X whose rows are `count` packed strips: tiles of 8x8 on and below the diagonal, whole
  /// ones. C points at the first element, column-major.
  void (*subtractStrips)(double* C, int stride, const double* packed, int count, int depth);

  /// Each strip X becomes X L^-T. L is depth x depth, row-major, its strictly lower part is used; `inverse` holds the
  /// inverses of its diagonal, and a zero there makes a zero column.
  void (*solveStrips)(double* packed, int count, int depth, const double* L, const double* inverse);

  /// sum a[i] b[i].
  double (*dot)(const double* a, const double* b, int n);
  /// The same of one vector with each of six, `stride` numbers from one to the next.
  void (*dotSix)(const double* a, const double* b, int stride, int n, double* products);
  /// y -= factor x.
  void (*subtract)(double* y, const double* x, double factor, int n);
  /// y -= factors[0] x0, then factors[1] x1, then factors[2] x2.
  void (*subtractThree)(double* y, const double* x0, const double* x1, const double* x2, const double* factors, int n);

  /// Y -= L X for eight right-hand sides at once, which lie side by side: row r of Y begins at Y + 8 r, row k of X at X
  /// + 8 k. L(r, k) is L[r * row_step + k * column_step].
  void (*subtractEight)(double* Y, int rows, const double* L, int row_step, int column_step, const double* X,
                        int columns);
};

/// What this machine can run, fastest first. The last is always there.
std::vector<InstructionSet> instructionSets();

/// By the fastest set.
double dot(const double* a, const double* b, int n);
void dotSix(const double* a, const double* b, int stride, int n, double* products);
void subtract(double* y, const double* x, double factor, int n);
void subtractThree(double* y, const double* x0, const double* x1, const double* x2, const double* factors, int n);

}  // namespace urban_nav_core::kernels
