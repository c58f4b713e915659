// SPDX-License-Identifier: BSD-3-Clause
#include "window/dense_kernels.hpp"

#include <cstddef>
#include <cstring>

#if defined(__x86_64__)
#define SWF_VO_X86 1
#endif

namespace swf_vo::kernels {

namespace {

// Vectors of the compiler's own, so that one text serves every width.
struct Narrow {
  typedef double Vector __attribute__((vector_size(16), aligned(8)));
  static constexpr int lanes = 2, vectors = 2, columns = 4;
};
struct Middle {
  typedef double Vector __attribute__((vector_size(32), aligned(8)));
  static constexpr int lanes = 4, vectors = 2, columns = 4;
};
struct Wide {
  typedef double Vector __attribute__((vector_size(64), aligned(8)));
  static constexpr int lanes = 8, vectors = 1, columns = 8;
};

template <typename Width>
__attribute__((always_inline)) inline void tile(double* C, std::ptrdiff_t stride, const double* a, const double* b, int depth) {
  using Vector = typename Width::Vector;
  Vector sum[Width::columns][Width::vectors];
  for (int c = 0; c < Width::columns; ++c)
    for (int v = 0; v < Width::vectors; ++v) sum[c][v] = Vector{};
  for (int k = 0; k < depth; ++k) {
    Vector x[Width::vectors];
    for (int v = 0; v < Width::vectors; ++v) x[v] = *reinterpret_cast<const Vector*>(a + k * strip + v * Width::lanes);
#pragma GCC unroll 8
    for (int c = 0; c < Width::columns; ++c) {
      const double y = b[k * strip + c];
      for (int v = 0; v < Width::vectors; ++v) sum[c][v] += x[v] * y;
    }
  }
  for (int c = 0; c < Width::columns; ++c)
    for (int v = 0; v < Width::vectors; ++v) *reinterpret_cast<Vector*>(C + c * stride + v * Width::lanes) -= sum[c][v];
}

template <typename Width>
__attribute__((always_inline)) inline void subtractStripsAs(double* C, int stride, const double* packed, int count, int depth) {
  const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(strip) * depth;
  constexpr int rows = Width::lanes * Width::vectors;
  for (int j = 0; j < count; ++j)
    for (int i = j; i < count; ++i)
      for (int r = 0; r < strip; r += rows)
        for (int c = 0; c < strip; c += Width::columns)
          tile<Width>(C + static_cast<std::ptrdiff_t>(j * strip + c) * stride + i * strip + r, stride, packed + i * size + r, packed + j * size + c, depth);
}

// Four vectors at a time, for a sum must wait for the one before.
template <typename Width, int several>
__attribute__((always_inline)) inline void solveAs(double* X, std::ptrdiff_t apart, int depth, const double* L, const double* inverse) {
  using Vector = typename Width::Vector;
  for (int j = 0; j < depth; ++j) {
    Vector sum[several];
    for (int s = 0; s < several; ++s) sum[s] = *reinterpret_cast<const Vector*>(X + s * apart + j * strip);
    for (int k = 0; k < j; ++k) {
      const double factor = L[j * depth + k];
      for (int s = 0; s < several; ++s) sum[s] -= *reinterpret_cast<const Vector*>(X + s * apart + k * strip) * factor;
    }
    for (int s = 0; s < several; ++s) *reinterpret_cast<Vector*>(X + s * apart + j * strip) = sum[s] * inverse[j];
  }
}

template <typename Width>
__attribute__((always_inline)) inline void solveStripsAs(double* packed, int count, int depth, const double* L, const double* inverse) {
  const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(strip) * depth;
  for (int r = 0; r < strip; r += Width::lanes) {
    int i = 0;
    for (; i + 4 <= count; i += 4) solveAs<Width, 4>(packed + i * size + r, size, depth, L, inverse);
    for (; i < count; ++i) solveAs<Width, 1>(packed + i * size + r, size, depth, L, inverse);
  }
}

void subtractNarrow(double* C, int stride, const double* packed, int count, int depth) { subtractStripsAs<Narrow>(C, stride, packed, count, depth); }
void solveNarrow(double* packed, int count, int depth, const double* L, const double* inverse) {
  solveStripsAs<Narrow>(packed, count, depth, L, inverse);
}
#ifdef SWF_VO_X86
__attribute__((target("avx2"))) void subtractMiddle(double* C, int stride, const double* packed, int count, int depth) {
  subtractStripsAs<Middle>(C, stride, packed, count, depth);
}
__attribute__((target("avx2"))) void solveMiddle(double* packed, int count, int depth, const double* L, const double* inverse) {
  solveStripsAs<Middle>(packed, count, depth, L, inverse);
}
__attribute__((target("avx512f"))) void subtractWide(double* C, int stride, const double* packed, int count, int depth) {
  subtractStripsAs<Wide>(C, stride, packed, count, depth);
}
__attribute__((target("avx512f"))) void solveWide(double* packed, int count, int depth, const double* L, const double* inverse) {
  solveStripsAs<Wide>(packed, count, depth, L, inverse);
}
#endif

constexpr InstructionSet sets[] = {
#ifdef SWF_VO_X86
    {"avx512f", subtractWide, solveWide},
    {"avx2", subtractMiddle, solveMiddle},
#endif
    {"baseline", subtractNarrow, solveNarrow},
};

bool supports(const InstructionSet& set) {
#ifdef SWF_VO_X86
  if (std::strcmp(set.name, "avx512f") == 0) return __builtin_cpu_supports("avx512f") != 0;
  if (std::strcmp(set.name, "avx2") == 0) return __builtin_cpu_supports("avx2") != 0;
#endif
  return std::strcmp(set.name, "baseline") == 0;
}

}  // namespace

std::vector<InstructionSet> instructionSets() {
  std::vector<InstructionSet> result;
  for (const InstructionSet& set : sets)
    if (supports(set)) result.push_back(set);
  return result;
}

double dot(const double* a, const double* b, int n) {
  double sum[8] = {};
  int i = 0;
  for (; i + 8 <= n; i += 8)
    for (int l = 0; l < 8; ++l) sum[l] += a[i + l] * b[i + l];
  double rest = 0.0;
  for (; i < n; ++i) rest += a[i] * b[i];
  return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7])) + rest;
}

void subtract(double* y, const double* x, double factor, int n) {
  for (int i = 0; i < n; ++i) y[i] -= x[i] * factor;
}

}  // namespace swf_vo::kernels
