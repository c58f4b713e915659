// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "padded.hpp"
#include "refine/plane_fit.hpp"

namespace dense_stereo {

/// Relation of the grey levels of both images: left = gain right + offset.
struct Exposure {
  float gain = 1.0F, offset = 0.0F;
};

/// Disparities with the results of window alignment.
struct DisparityField {
  static constexpr float kInvalid = -1000.0F;
  Padded<float> disparity;    ///< px, `kInvalid` or at least 0
  Padded<float> noise;        ///< variance of the difference of the two images in the window, grey levels^2
  Padded<float> information;  ///< squared gradients in the window used for the disparity, (grey levels/px)^2
};

/// Refines disparities to subpixels such that the right image, sampled through a window whose disparities lie on a
/// plane, equals the left one: one step of Lucas and Kanade (1981) for all pixels at once. Each pixel contributes one
/// linear equation at its own disparity, and the sums over windows of 9x10 are box filters; two rows share a plane.
/// Slanted surfaces are therefore aligned without bias, and there is no pixel locking. Near a depth edge a window of
/// 7x7 without the pixels of other surfaces is used instead. V: Floats, or PlainFloats for the bit-identical reference.
/// Not thread-safe.
template <typename V>
class SlantedAlignment {
 public:
  void resize(int width, int height);
  /// Performs one step from `start`, whose disparities are integers. Image rows must be extended by extendRows();
  /// `edges`: nonzero within a window of a depth edge. `result` must not be `start`.
  void step(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right, const Exposure& exposure,
            const Padded<std::uint8_t>& edges, const Padded<float>& start, DisparityField& result);

 private:
  static constexpr int kRadius = 4;
  static constexpr int kRows = 2 * kRadius + 2;  ///< of windows centred between two rows
  /// Per pixel: gradient, its square, value, gradient times value, difference and its square, 1 if valid. Then sums
  /// along the row, those ending in U with weights u, in UU with u^2.
  enum Channel : std::size_t {
    G,
    GG,
    Q,
    GQ,
    Difference,
    Square,
    Valid,
    SumG,
    SumGU,
    SumGG,
    SumGGU,
    SumGGUU,
    SumQ,
    SumGQ,
    SumGQU,
    Differences,
    Squares,
    Count,
    channels
  };

  float* channel(int v, Channel c) {
    return ring_.data() + (static_cast<std::size_t>(v % kRows) * channels + c) * stride_ + Padded<float>::kPadding;
  }
  struct PlaneAtEdge {
    PlaneFit<float> plane;
    float noise;
  };
  using Lines = std::array<const float*, kRows>;  ///< first channel of each row of the window
  Lines linesAround(int v);
  void clearRow(int v);
  void measureRow(const std::uint8_t* left, const std::uint8_t* right, const Exposure& exposure, const float* start,
                  int v);
  void sumRow(int v);
  /// Solves rows v and v + 1.
  void solveRows(int v, const Padded<float>& start, DisparityField& result);
  void solveEdges(int v, const Padded<std::uint8_t>& edges, const Padded<float>& start, DisparityField& result);
  PlaneAtEdge fitAtEdge(const Lines& lines, int u, int v, float disparity, const Padded<float>& start) const;

  int width_ = 0, height_ = 0;
  std::size_t stride_ = 0;
  std::vector<float> ring_;
  std::vector<float> left_, left_slope_, right_;  ///< of one row: smoothed pixels and their derivatives
  std::vector<float> right_pairs_;                ///< value and derivative interleaved
};

}  // namespace dense_stereo
