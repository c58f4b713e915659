// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_python {

using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Returns a matrix as an array of two dimensions, row by row.
template <typename Matrix>
Doubles toArray(const Matrix& matrix) {
  Doubles array({matrix.rows(), matrix.cols()});
  auto out = array.mutable_unchecked<2>();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r)
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) out(r, c) = matrix(r, c);
  return array;
}

/// Returns n square matrices of this size as an array of three dimensions.
template <int kSize>
Doubles toStack(const std::vector<Eigen::Matrix<double, kSize, kSize>>& matrices) {
  Doubles array({static_cast<pybind11::ssize_t>(matrices.size()), pybind11::ssize_t{kSize}, pybind11::ssize_t{kSize}});
  double* out = array.mutable_data();
  for (const auto& matrix : matrices)
    for (int r = 0; r < kSize; ++r)
      for (int c = 0; c < kSize; ++c) *out++ = matrix(r, c);
  return array;
}

/// Returns the matrix in an array of the same size, which the caller has checked.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> toMatrix(const Doubles& array) {
  Eigen::Matrix<double, kSize, kSize> matrix;
  for (int r = 0; r < kSize; ++r)
    for (int c = 0; c < kSize; ++c) matrix(r, c) = array.data()[r * kSize + c];
  return matrix;
}

}  // namespace urban_nav_python
