// SPDX-License-Identifier: BSD-3-Clause
#include "blocks/matrix_bytes.hpp"

#include "urban_nav_store/bytes.hpp"

namespace urban_nav_store {

using urban_nav_core::Matrix6d;

std::string matrixBytes(const Matrix6d& matrix) {
  const bool symmetric = matrix == matrix.transpose();
  std::string bytes;
  bytes.reserve(36 * sizeof(double));
  for (int row = 0; row < 6; ++row)
    for (int column = symmetric ? row : 0; column < 6; ++column) appendNumber(bytes, matrix(row, column));
  return bytes;
}

bool parseMatrix(std::string_view bytes, Matrix6d& matrix) {
  const bool symmetric = bytes.size() == 21 * sizeof(double);
  if (!symmetric && bytes.size() != 36 * sizeof(double)) return false;
  ByteReader reader(bytes);
  for (int row = 0; row < 6; ++row) {
    for (int column = symmetric ? row : 0; column < 6; ++column) {
      matrix(row, column) = reader.number();
      if (symmetric) matrix(column, row) = matrix(row, column);
    }
  }
  return matrix.allFinite();
}

}  // namespace urban_nav_store
