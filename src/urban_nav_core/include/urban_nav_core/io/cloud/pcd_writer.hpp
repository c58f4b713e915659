// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/io/cloud/record_file.hpp"

namespace urban_nav_core {

/// Field of the points of a PCD file.
struct PcdField {
  std::string name;
  int bytes = 4;    ///< size of its single value
  char type = 'F';  ///< 'F' floating point, 'U' unsigned, 'I' signed
};

/// Returns the header of a binary PCD file, version 0.7, of an unordered cloud. Its length does not depend on the
/// number of points.
std::string pcdHeader(const std::vector<PcdField>& fields, std::size_t points);

/// Writes a binary PCD file (Rusu and Cousins 2011) whose number of points need not be known in advance. A point is the
/// values of its fields in little-endian order without padding. The file is written completely or not at all. Not
/// thread-safe. Throws UserError or DataError naming the path.
class PcdWriter {
 public:
  PcdWriter(const std::string& path, std::vector<PcdField> fields);

  /// Appends points. Requires a whole number of them.
  void append(std::string_view points) { file_.append(points); }
  std::size_t points() const { return file_.records(); }
  /// Writes the header and renames the file to its final name.
  void commit() { file_.commit(pcdHeader(fields_, points())); }

 private:
  std::vector<PcdField> fields_;
  RecordFile file_;
};

}  // namespace urban_nav_core
