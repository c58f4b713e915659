// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/dense_kernels.hpp"

#include <cstddef>
#include <cstring>

#if defined(__x86_64__)
#define URBAN_NAV_X86 1
#endif

namespace urban_nav_core::kernels {

namespace {

// GCC vector types, so that one source serves every width.
struct Narrow {
  typedef double Vector __attribute__((vector_size(16), aligned(8)));
  static constexpr int kLanes = 2, kVectors = 2, kColumns = 4;
};
struct Middle {
  typedef double Vector __attribute__((vector_size(32), aligned(8)));
  static constexpr int kLanes = 4, kVectors = 2, kColumns = 4;
};
struct Wide {
  typedef double Vector __attribute__((vector_size(64), aligned(8)));
  static constexpr int kLanes = 8, kVectors = 1, kColumns = 8;
};

template <typename Width>
__attribute__((always_inline)) inline void tile(double* C, std::ptrdiff_t stride, const double* a, const double* b,
                                                int depth) {
  using Vector = typename Width::Vector;
  Vector sum[Width::kColumns][Width::kVectors];
#pragma GCC unroll 8
  for (int c = 0; c < Width::kColumns; ++c)
#pragma GCC unroll 8
    for (int v = 0; v < Width::kVectors; ++v) sum[c][v] = Vector{};
  for (int k = 0; k < depth; ++k) {
    Vector x[Width::kVectors];
#pragma GCC unroll 8
    for (int v = 0; v < Width::kVectors; ++v)
      x[v] = *reinterpret_cast<const Vector*>(a + k * kStrip + v * Width::kLanes);
#pragma GCC unroll 8
    for (int c = 0; c < Width::kColumns; ++c) {
      const double y = b[k * kStrip + c];
#pragma GCC unroll 8
      for (int v = 0; v < Width::kVectors; ++v) sum[c][v] += x[v] * y;
    }
  }
#pragma GCC unroll 8
  for (int c = 0; c < Width::kColumns; ++c)
#pragma GCC unroll 8
    for (int v = 0; v < Width::kVectors; ++v)
      *reinterpret_cast<Vector*>(C + c * stride + v * Width::kLanes) -= sum[c][v];
}

template <typename Width>
__attribute__((always_inline)) inline void subtractStripsAs(double* C, int stride, const double* packed, int count,
                                                            int depth) {
  const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(kStrip) * depth;
  constexpr int kRows = Width::kLanes * Width::kVectors;
  for (int j = 0; j < count; ++j)
    for (int i = j; i < count; ++i)
      for (int r = 0; r < kStrip; r += kRows)
        for (int c = 0; c < kStrip; c += Width::kColumns)
          tile<Width>(C + static_cast<std::ptrdiff_t>(j * kStrip + c) * stride + i * kStrip + r, stride,
                      packed + i * size + r, packed + j * size + c, depth);
}

// Four independent vector accumulators, because each sum depends on the previous one.
template <typename Width, int several>
__attribute__((always_inline)) inline void solveAs(double* X, std::ptrdiff_t apart, int depth, const double* L,
                                                   const double* inverse) {
  using Vector = typename Width::Vector;
  for (int j = 0; j < depth; ++j) {
    Vector sum[several];
#pragma GCC unroll 8
    for (int s = 0; s < several; ++s) sum[s] = *reinterpret_cast<const Vector*>(X + s * apart + j * kStrip);
    for (int k = 0; k < j; ++k) {
      const double factor = L[j * depth + k];
#pragma GCC unroll 8
      for (int s = 0; s < several; ++s) sum[s] -= *reinterpret_cast<const Vector*>(X + s * apart + k * kStrip) * factor;
    }
#pragma GCC unroll 8
    for (int s = 0; s < several; ++s) *reinterpret_cast<Vector*>(X + s * apart + j * kStrip) = sum[s] * inverse[j];
  }
}

template <typename Width>
__attribute__((always_inline)) inline void solveStripsAs(double* packed, int count, int depth, const double* L,
                                                         const double* inverse) {
  const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(kStrip) * depth;
  for (int r = 0; r < kStrip; r += Width::kLanes) {
    int i = 0;
    for (; i + 4 <= count; i += 4) solveAs<Width, 4>(packed + i * size + r, size, depth, L, inverse);
    for (; i < count; ++i) solveAs<Width, 1>(packed + i * size + r, size, depth, L, inverse);
  }
}

// Sixteen partial sums, independent of the vector width.
template <typename Width>
__attribute__((always_inline)) inline double dotAs(const double* a, const double* b, int n) {
  using Vector = typename Width::Vector;
  constexpr int kSums = 16, kVectors = kSums / Width::kLanes;
  Vector sum[kVectors];
#pragma GCC unroll 8
  for (int v = 0; v < kVectors; ++v) sum[v] = Vector{};
  int i = 0;
  for (; i + kSums <= n; i += kSums) {
#pragma GCC unroll 8
    for (int v = 0; v < kVectors; ++v)
      sum[v] += *reinterpret_cast<const Vector*>(a + i + v * Width::kLanes) *
                *reinterpret_cast<const Vector*>(b + i + v * Width::kLanes);
  }
  for (; i + kSums / 2 <= n; i += kSums / 2) {
#pragma GCC unroll 8
    for (int v = 0; v < kVectors / 2; ++v)
      sum[v] += *reinterpret_cast<const Vector*>(a + i + v * Width::kLanes) *
                *reinterpret_cast<const Vector*>(b + i + v * Width::kLanes);
  }
#pragma GCC unroll 8
  for (int v = 0; v < kVectors / 2; ++v) sum[v] += sum[v + kVectors / 2];
  double each[kSums / 2];
  std::memcpy(each, sum, sizeof each);
  double rest = 0.0;
  for (; i < n; ++i) rest += a[i] * b[i];
  return ((each[0] + each[4]) + (each[2] + each[6])) + ((each[1] + each[5]) + (each[3] + each[7])) + rest;
}

// Eight partial sums for each product, independent of the vector width; `a` is read once.
template <typename Width>
__attribute__((always_inline)) inline void dotSixAs(const double* a, const double* b, std::ptrdiff_t stride, int n,
                                                    double* products) {
  using Vector = typename Width::Vector;
  constexpr int kSums = 8, kVectors = kSums / Width::kLanes,
                kTogether = Width::kLanes == 2 ? 3 : 6;  // limited by the number of registers
  for (int first = 0; first < 6; first += kTogether) {
    Vector sum[kTogether][kVectors];
#pragma GCC unroll 6
    for (int c = 0; c < kTogether; ++c)
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) sum[c][v] = Vector{};
    int i = 0;
    for (; i + kSums <= n; i += kSums)
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) {
        const Vector x = *reinterpret_cast<const Vector*>(a + i + v * Width::kLanes);
#pragma GCC unroll 6
        for (int c = 0; c < kTogether; ++c)
          sum[c][v] += x * *reinterpret_cast<const Vector*>(b + (first + c) * stride + i + v * Width::kLanes);
      }
    for (int c = 0; c < kTogether; ++c) {
      double each[kSums], rest = 0.0;
      std::memcpy(each, sum[c], sizeof each);
      for (int k = i; k < n; ++k) rest += a[k] * b[(first + c) * stride + k];
      products[first + c] =
          ((each[0] + each[4]) + (each[2] + each[6])) + ((each[1] + each[5]) + (each[3] + each[7])) + rest;
    }
  }
}

template <typename Width>
__attribute__((always_inline)) inline void subtractAs(double* y, const double* x, double factor, int n) {
  using Vector = typename Width::Vector;
  int i = 0;
  for (; i + 8 <= n; i += 8)
#pragma GCC unroll 4
    for (int v = 0; v < 8; v += Width::kLanes)
      *reinterpret_cast<Vector*>(y + i + v) -= *reinterpret_cast<const Vector*>(x + i + v) * factor;
  for (; i < n; ++i) y[i] -= x[i] * factor;
}

template <typename Width>
__attribute__((always_inline)) inline void subtractThreeAs(double* y, const double* x0, const double* x1,
                                                           const double* x2, const double* f, int n) {
  using Vector = typename Width::Vector;
  const double a = f[0], b = f[1], c = f[2];
  int i = 0;
  for (; i + 8 <= n; i += 8)
#pragma GCC unroll 4
    for (int v = i; v < i + 8; v += Width::kLanes) {
      const Vector first = *reinterpret_cast<const Vector*>(y + v) - *reinterpret_cast<const Vector*>(x0 + v) * a;
      *reinterpret_cast<Vector*>(y + v) =
          first - *reinterpret_cast<const Vector*>(x1 + v) * b - *reinterpret_cast<const Vector*>(x2 + v) * c;
    }
  for (; i < n; ++i) y[i] = y[i] - x0[i] * a - x1[i] * b - x2[i] * c;
}

template <typename Width, int rows>
__attribute__((always_inline)) inline void subtractEightRows(double* Y, const double* L, std::ptrdiff_t row_step,
                                                             std::ptrdiff_t column_step, const double* X, int columns) {
  using Vector = typename Width::Vector;
  constexpr int kVectors = 8 / Width::kLanes;
  Vector sum[rows][kVectors];
#pragma GCC unroll 8
  for (int r = 0; r < rows; ++r)
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) sum[r][v] = Vector{};
  for (int k = 0; k < columns; ++k, X += 8, L += column_step) {
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) {
      const Vector x = *reinterpret_cast<const Vector*>(X + v * Width::kLanes);
#pragma GCC unroll 8
      for (int r = 0; r < rows; ++r) sum[r][v] += x * L[r * row_step];
    }
  }
#pragma GCC unroll 8
  for (int r = 0; r < rows; ++r)
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) *reinterpret_cast<Vector*>(Y + r * 8 + v * Width::kLanes) -= sum[r][v];
}

template <typename Width>
__attribute__((always_inline)) inline void subtractEightAs(double* Y, int rows, const double* L,
                                                           std::ptrdiff_t row_step, std::ptrdiff_t column_step,
                                                           const double* X, int columns) {
  constexpr int kTogether = Width::kLanes;  // limited by the number of registers
  int r = 0;
  for (; r + kTogether <= rows; r += kTogether)
    subtractEightRows<Width, kTogether>(Y + r * 8, L + r * row_step, row_step, column_step, X, columns);
  for (; r < rows; ++r) subtractEightRows<Width, 1>(Y + r * 8, L + r * row_step, row_step, column_step, X, columns);
}

// One function of each kind per width: the target processor is an attribute of the function.
// NOLINTBEGIN(bugprone-macro-parentheses): type names and attributes cannot be in parentheses
#define URBAN_NAV_KERNELS(Width, target)                                                                         \
  target void subtractStrips##Width(double* C, int stride, const double* packed, int count, int depth) {         \
    subtractStripsAs<Width>(C, stride, packed, count, depth);                                                    \
  }                                                                                                              \
  target void solveStrips##Width(double* packed, int count, int depth, const double* L, const double* inverse) { \
    solveStripsAs<Width>(packed, count, depth, L, inverse);                                                      \
  }                                                                                                              \
  target double dot##Width(const double* a, const double* b, int n) { return dotAs<Width>(a, b, n); }            \
  target void dotSix##Width(const double* a, const double* b, int stride, int n, double* products) {             \
    dotSixAs<Width>(a, b, stride, n, products);                                                                  \
  }                                                                                                              \
  target void subtract##Width(double* y, const double* x, double factor, int n) {                                \
    subtractAs<Width>(y, x, factor, n);                                                                          \
  }                                                                                                              \
  target void subtractThree##Width(double* y, const double* x0, const double* x1, const double* x2,              \
                                   const double* factors, int n) {                                               \
    subtractThreeAs<Width>(y, x0, x1, x2, factors, n);                                                           \
  }                                                                                                              \
  target void subtractEight##Width(double* Y, int rows, const double* L, int row_step, int column_step,          \
                                   const double* X, int columns) {                                               \
    subtractEightAs<Width>(Y, rows, L, row_step, column_step, X, columns);                                       \
  }
#define URBAN_NAV_SET(name, Width)                                                                                     \
  {                                                                                                                    \
    name, subtractStrips##Width, solveStrips##Width, dot##Width, dotSix##Width, subtract##Width, subtractThree##Width, \
        subtractEight##Width                                                                                           \
  }
// NOLINTEND(bugprone-macro-parentheses)

URBAN_NAV_KERNELS(Narrow, )
#ifdef URBAN_NAV_X86
URBAN_NAV_KERNELS(Middle, __attribute__((target("avx2"))))
URBAN_NAV_KERNELS(Wide, __attribute__((target("avx512f"))))
#endif

constexpr InstructionSet kSets[] = {
#ifdef URBAN_NAV_X86
    URBAN_NAV_SET("avx512f", Wide),
    URBAN_NAV_SET("avx2", Middle),
#endif
    URBAN_NAV_SET("baseline", Narrow),
};

bool supports(const InstructionSet& set) {
#ifdef URBAN_NAV_X86
  if (std::strcmp(set.name, "avx512f") == 0) return __builtin_cpu_supports("avx512f") != 0;
  if (std::strcmp(set.name, "avx2") == 0) return __builtin_cpu_supports("avx2") != 0;
#endif
  return std::strcmp(set.name, "baseline") == 0;
}

const InstructionSet& fastest() {
  static const InstructionSet set = instructionSets().front();
  return set;
}

}  // namespace

std::vector<InstructionSet> instructionSets() {
  std::vector<InstructionSet> result;
  for (const InstructionSet& set : kSets)
    if (supports(set)) result.push_back(set);
  return result;
}

double dot(const double* a, const double* b, int n) { return fastest().dot(a, b, n); }
void dotSix(const double* a, const double* b, int stride, int n, double* products) {
  fastest().dotSix(a, b, stride, n, products);
}
void subtract(double* y, const double* x, double factor, int n) { fastest().subtract(y, x, factor, n); }
void subtractThree(double* y, const double* x0, const double* x1, const double* x2, const double* factors, int n) {
  fastest().subtractThree(y, x0, x1, x2, factors, n);
}

}  // namespace urban_nav_core::kernels
