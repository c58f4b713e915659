// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace urban_nav_core::kernels {

/// Inner loops of the dense Cholesky. Own code, because Eigen compiled for the portable baseline reaches a quarter of
/// the processor's throughput. The instruction set is chosen at run time. Summation order is fixed and no operations
/// are fused, so results are bit-identical for all instruction sets.
///
/// A strip of 8 rows and `depth` columns is stored as `depth` groups of 8 numbers; strips follow one another.
constexpr int kStrip = 8;
/// The kernels compiled for one instruction set.
struct InstructionSet {
  const char* name;

  /// C -= X X^T for the matrix X whose rows are `count` packed strips: complete 8x8 tiles on and below the diagonal. C
  /// points at the first element, column-major.
  void (*subtractStrips)(double* C, int stride, const double* packed, int count, int depth);

  /// Replaces each strip X by X L^-T. L is depth x depth, row-major; its strictly lower part is read. `inverse` holds
  /// the reciprocals of its diagonal; a zero there yields a zero column.
  void (*solveStrips)(double* packed, int count, int depth, const double* L, const double* inverse);

  /// sum a[i] b[i].
  double (*dot)(const double* a, const double* b, int n);
  /// products[k] = sum a[i] b[k * stride + i] for k = 0...5.
  void (*dotSix)(const double* a, const double* b, int stride, int n, double* products);
  /// y -= factor x.
  void (*subtract)(double* y, const double* x, double factor, int n);
  /// y -= factors[0] x0, then factors[1] x1, then factors[2] x2.
  void (*subtractThree)(double* y, const double* x0, const double* x1, const double* x2, const double* factors, int n);

  /// Y -= L X for eight interleaved right-hand sides: row r of Y begins at Y + 8 r, row k of X at X + 8 k. L(r, k) is
  /// L[r * row_step + k * column_step].
  void (*subtractEight)(double* Y, int rows, const double* L, int row_step, int column_step, const double* X,
                        int columns);
};

/// Returns the instruction sets that this machine supports, fastest first. The last one is supported everywhere.
std::vector<InstructionSet> instructionSets();

/// Calls of the fastest instruction set.
double dot(const double* a, const double* b, int n);
void dotSix(const double* a, const double* b, int stride, int n, double* products);
void subtract(double* y, const double* x, double factor, int n);
void subtractThree(double* y, const double* x0, const double* x1, const double* x2, const double* factors, int n);

}  // namespace urban_nav_core::kernels
