// SPDX-License-Identifier: BSD-3-Clause
#include "linear/front.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "linear/index.hpp"

namespace pose_graph {

namespace {

using urban_nav_core::kernels::kStrip;

constexpr double kZeroPivot = 1e-12;  // relative to the size of a pivot: round-off of a zero pivot
constexpr int kPanel = 48;            // columns eliminated together: bench/linear

}  // namespace

void Front::reset(int size) {
  size_ = size;
  stride_ = (size + kStrip - 1) / kStrip * kStrip + kStrip;
  const std::size_t room = sz(stride_) * sz(stride_);
  if (data_.size() < room) data_.resize(room);
  // Only the lower triangle is read. A tile that crosses the diagonal or the end computes unused numbers; it begins up
  // to seven rows above the diagonal.
  for (int j = 0; j < stride_; ++j) {
    const int first = std::max(0, j - kStrip + 1);
    std::memset(column(j) + first, 0, sz(stride_ - first) * sizeof(double));
  }
}

bool Front::eliminateDiagonal(int start, int width, Pins* pins) {
  lower_.resize(sz(width) * sz(width));
  inverse_.resize(sz(width));
  for (int j = 0; j < width; ++j) {
    double* a = column(start + j) + start;
    if (pins != nullptr && a[j] <= kZeroPivot * pins->size[sz(start + j)]) {
      a[j] = std::max(a[j], 0.0) + kPin * pins->size[sz(start + j)];
      pins->columns.push_back(start + j);
    }
    if (!(a[j] > 0.0) || !std::isfinite(a[j])) return false;
    a[j] = std::sqrt(a[j]);
    inverse_[sz(j)] = 1.0 / a[j];
    for (int i = j + 1; i < width; ++i) {
      a[i] *= inverse_[sz(j)];
      lower_[sz(i) * sz(width) + sz(j)] = a[i];
    }
    for (int k = j + 1; k < width; ++k) kernels_.subtract(column(start + k) + start + k, a + k, a[k], width - k);
  }
  return true;
}

bool Front::eliminate(int pivots) { return eliminate(pivots, nullptr); }

bool Front::eliminate(int pivots, Pins* pins) {
  for (int start = 0; start < pivots; start += kPanel) {
    const int width = std::min(kPanel, pivots - start), below = start + width;
    if (!eliminateDiagonal(start, width, pins)) return false;
    const int rows = size_ - below, strips = (rows + kStrip - 1) / kStrip;
    if (strips == 0) continue;
    const std::size_t piece = sz(kStrip) * sz(width);
    packed_.resize(sz(strips) * piece);
    for (int c = 0; c < width; ++c) {
      const double* source = column(start + c) + below;
      for (int s = 0; s < strips; ++s)
        std::memcpy(&packed_[sz(s) * piece + sz(c) * kStrip], source + s * kStrip, kStrip * sizeof(double));
    }
    // Entries after the last row are padding.
    for (int c = 0; c < width; ++c)
      for (int r = rows; r < strips * kStrip; ++r)
        packed_[sz(strips - 1) * piece + sz(c) * kStrip + sz(r % kStrip)] = 0.0;
    kernels_.solveStrips(packed_.data(), strips, width, lower_.data(), inverse_.data());
    for (int c = 0; c < width; ++c) {
      double* target = column(start + c) + below;
      for (int s = 0; s < strips; ++s)
        std::memcpy(target + s * kStrip, &packed_[sz(s) * piece + sz(c) * kStrip], kStrip * sizeof(double));
    }
    kernels_.subtractStrips(column(below) + below, stride_, packed_.data(), strips, width);
  }
  return true;
}

}  // namespace pose_graph
