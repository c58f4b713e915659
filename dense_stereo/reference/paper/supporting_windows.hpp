// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "padded.hpp"

namespace dense_stereo {

/// Scores of one row of pixels at every disparity, and the best disparities of the right image in that row.
struct ScoreRow {
  const std::uint16_t* scores;  ///< width x disparities; 65535 where the match lies outside the right image
  const std::uint16_t* right_disparity;
};

/// Sums of absolute differences over windows of 11x11 at every disparity, refined by supporting windows (Hirschmueller,
/// Innocent, Garibaldi 2002): the window of the pixel plus the best two of the four windows at its corners. Rows are
/// computed from top to bottom. Windows repeat the border of the image. V: Words, or PlainWords for the reference, with
/// the same result. Not thread-safe.
template <typename V>
class SupportingWindows {
 public:
  /// `disparities`: a multiple of 16. Images are those of LogFilter, whose differences are at most 126.
  void begin(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right, int disparities);
  /// Returns the next row, valid until the next call.
  ScoreRow next();

 private:
  static constexpr int kRadius = 5;                  ///< px, of the windows
  static constexpr int kKeptRows = 2 * kRadius + 1;  ///< of window sums

  void addRow(int v, bool is_added);
  void sumAlong(int v);
  const std::uint16_t* computeSums(int v) const;
  void scoreRow(int v);
  void findRightWinners();

  const Padded<std::uint8_t>* left_ = nullptr;
  const Padded<std::uint8_t>* right_ = nullptr;
  int width_ = 0, height_ = 0, disparities_ = 0;
  int summed_ = 0, scored_ = 0;         ///< rows
  std::vector<std::uint8_t> reversed_;  ///< a row of the right image from its right end
  std::vector<std::uint16_t> columns_;  ///< sums over 11 rows of each column
  std::vector<std::uint16_t> windows_;  ///< sums over windows, the last rows
  std::vector<std::uint16_t> scores_, right_cost_, right_disparity_;
};

}  // namespace dense_stereo
