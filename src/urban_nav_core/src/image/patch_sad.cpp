// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>

#include "sad_row.hpp"
#include "urban_nav_core/image/patch.hpp"

namespace urban_nav_core {
namespace {

constexpr int kSadCount = SadPatch::kColumns * SadPatch::kRows;

std::int16_t roundedMean(int sum) { return static_cast<std::int16_t>((2 * sum + kSadCount) / (2 * kSadCount)); }

}  // namespace

SadPatch sadPatch(const PatchTemplate& patch) {
  double sum = 0.0;
  for (int v = 0; v < SadPatch::kRows; ++v)
    for (int u = 0; u < SadPatch::kColumns; ++u)
      sum += static_cast<double>(patch.value[static_cast<std::size_t>((v + 1) * kPatchStride + u + 1)]);
  const double mean = sum / kSadCount;
  SadPatch made;
  for (int v = 0; v < SadPatch::kRows; ++v)
    for (int u = 0; u < SadPatch::kColumns; ++u) {
      const double value = static_cast<double>(patch.value[static_cast<std::size_t>((v + 1) * kPatchStride + u + 1)]);
      made.value[static_cast<std::size_t>(v * SadPatch::kColumns + u)] =
          static_cast<std::int16_t>(std::lround(value - mean));
    }
  return made;
}

SadPatch sadPatch(const ImageView& image, int u, int v) {
  SadPatch made;
  int sum = 0;
  for (int j = 0; j < SadPatch::kRows; ++j)
    for (int i = 0; i < SadPatch::kColumns; ++i) {
      const std::uint8_t value = image.at(u - 4 + i, v - 4 + j);
      made.value[static_cast<std::size_t>(j * SadPatch::kColumns + i)] = value;
      sum += value;
    }
  for (std::int16_t& value : made.value) value = static_cast<std::int16_t>(value - roundedMean(sum));
  return made;
}

int meanRemovedSad(const SadPatch& patch, const ImageView& image, int u, int v) {
  const std::uint8_t* row = image.row(v - 4) + (u - 4);
  cv::v_int16x8 pixels[SadPatch::kRows];
  cv::v_int16x8 columns = cv::v_setzero_s16();
  for (cv::v_int16x8& line : pixels) {
    line = cv::v_reinterpret_as_s16(cv::v_load_expand(row));
    columns += line;
    row += image.stride;
  }
  const cv::v_int16x8 mean = cv::v_setall_s16(roundedMean(static_cast<int>(cv::v_reduce_sum(columns))));
  cv::v_uint16x8 sad = cv::v_setzero_u16();
  const std::int16_t* wanted = patch.value.data();
  for (const cv::v_int16x8& line : pixels) {
    sad += cv::v_absdiff(line - mean, cv::v_load_aligned(wanted));
    wanted += SadPatch::kColumns;
  }
  return static_cast<int>(cv::v_reduce_sum(sad));
}

void meanRemovedSads(const SadPatch& patch, const ImageView& image, int u, int v, int count, int* sads) {
  static const sad_row::InstructionSet set = sad_row::instructionSets().front();
  if (count < set.lanes) {
    for (int i = 0; i < count; ++i) sads[i] = meanRemovedSad(patch, image, u + i, v);
    return;
  }
  const std::uint8_t* first = image.row(v - 4) + (u - 4);
  for (int i = 0; i < count; i += set.lanes) {
    const int at = std::min(i, count - set.lanes);  // processes some positions twice instead of reading beyond the last
    set.compare(patch.value.data(), first + at, image.stride, sads + at);
  }
}

}  // namespace urban_nav_core
