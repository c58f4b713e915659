// SPDX-License-Identifier: BSD-3-Clause
#include "sad_row.hpp"

#include "urban_nav_core/image/patch.hpp"
#include "vectors.hpp"

namespace urban_nav_core::sad_row {
namespace {

using vectors::load;
using vectors::store;

// One source serves every width.
struct Narrow {
  typedef std::uint8_t Bytes __attribute__((vector_size(8)));
  typedef std::int16_t Numbers __attribute__((vector_size(16)));
  static constexpr int kLanes = 8;
};
struct Middle {
  typedef std::uint8_t Bytes __attribute__((vector_size(16)));
  typedef std::int16_t Numbers __attribute__((vector_size(32)));
  static constexpr int kLanes = 16;
};

constexpr int kColumns = SadPatch::kColumns, kRows = SadPatch::kRows, kCount = kColumns * kRows;

template <typename Width>
URBAN_NAV_INLINE void compareAs(const std::int16_t* patch, const std::uint8_t* first, std::ptrdiff_t stride,
                                int* sads) {
  using V = typename Width::Numbers;
  constexpr int kLanes = Width::kLanes, kLine = kLanes + kColumns;
  alignas(32) std::int16_t pixels[kRows * kLine], sums[kLine];
  V near{}, far{};  // column by column, and seven further: no pixel beyond the last patch is read
  for (int j = 0; j < kRows; ++j) {
    const V a = __builtin_convertvector(load<typename Width::Bytes>(first + j * stride), V);
    const V b = __builtin_convertvector(load<typename Width::Bytes>(first + j * stride + kColumns - 1), V);
    store(pixels + j * kLine, a);
    store(pixels + j * kLine + kColumns - 1, b);
    near += a;
    far += b;
  }
  store(sums, near);
  store(sums + kColumns - 1, far);
  V sum{};
#pragma GCC unroll 8
  for (int i = 0; i < kColumns; ++i) sum += load<V>(sums + i);
  std::int16_t means[kLanes];
  store(means, sum);
  for (std::int16_t& mean : means)
    mean = static_cast<std::int16_t>((2U * static_cast<unsigned>(mean) + kCount) / (2U * kCount));
  const V mean = load<V>(means);
  V total{};  // up to 36 720: interpreted as unsigned
  for (int j = 0; j < kRows; ++j)
#pragma GCC unroll 8
    for (int i = 0; i < kColumns; ++i) {
      const V difference = load<V>(pixels + j * kLine + i) - mean - patch[j * kColumns + i];
      total += difference > V{} ? difference : -difference;
    }
  std::uint16_t result[kLanes];
  store(result, total);
  for (int l = 0; l < kLanes; ++l) sads[l] = result[l];
}

void compareNarrow(const std::int16_t* patch, const std::uint8_t* first, std::ptrdiff_t stride, int* sads) {
  compareAs<Narrow>(patch, first, stride, sads);
}
#ifdef URBAN_NAV_X86
__attribute__((target("avx2"))) void compareMiddle(const std::int16_t* patch, const std::uint8_t* first,
                                                   std::ptrdiff_t stride, int* sads) {
  compareAs<Middle>(patch, first, stride, sads);
}
#endif

}  // namespace

std::vector<InstructionSet> instructionSets() {
  std::vector<InstructionSet> sets;
#ifdef URBAN_NAV_X86
  if (__builtin_cpu_supports("avx2") != 0) sets.push_back({"avx2", Middle::kLanes, compareMiddle});
#endif
  sets.push_back({"baseline", Narrow::kLanes, compareNarrow});
  return sets;
}

}  // namespace urban_nav_core::sad_row
