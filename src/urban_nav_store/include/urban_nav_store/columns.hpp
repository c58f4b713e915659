// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_store {

/// Visitor of the columns of a row. A row lists its columns once, in table order, in one function for declaring,
/// writing and reading:
///
///   void Panorama::columns(Columns& columns) {
///     columns.text("session", session);
///     columns.integer("stamp_ns", stamp);
///     columns.blob("image", image);
///   }
///
/// Reading sets the values; writing and declaring do not change them. Values passed by reference must live until the
/// visit of the whole row has been used; scratch() holds converted ones.
class Columns {
 public:
  virtual ~Columns() = default;

  virtual bool isReading() const { return false; }
  /// Returns whether invalid values are refused: while reading, and before writing.
  virtual bool isValidating() const { return false; }
  /// Declares that the columns after this call were added to their table in this version of the schema. Older files
  /// have their default values.
  virtual void since(int /*version*/) {}

  virtual void text(const char* name, std::string& value) = 0;
  virtual void integer(const char* name, std::int64_t& value) = 0;
  /// Requires a finite value. -0 is stored as 0.
  virtual void real(const char* name, double& value) = 0;
  virtual void blob(const char* name, std::string& value) = 0;

  /// Integer column with the values 0 and 1.
  void flag(const char* name, bool& value);
  /// Seven columns: x y z (m) qx qy qz qw.
  void pose(urban_nav_core::Pose& value);
  /// Blob of little-endian numbers, row by row: 36, or the 21 of the upper triangle if the matrix is exactly symmetric.
  void matrix6(const char* name, urban_nav_core::Matrix6d& value);
  /// Blob, empty without constants: their number (eight bytes), then for each the name (length in eight bytes, text)
  /// and nine doubles: used, mean, sigma and the sensitivity.
  void constants(const char* name, urban_nav_core::ConsideredConstants& values);
  /// Stores an enumerator as the word of its toString().
  template <typename Word>
  void word(const char* name, Word& value, std::optional<Word> (*parse)(std::string_view)) {
    std::string& spelt = scratch();
    spelt = toString(value);
    text(name, spelt);
    if (!isReading()) return;
    const std::optional<Word> parsed = parse(spelt);
    if (!parsed) refuse(std::string(name) + " is an unknown value");
    value = *parsed;
  }

  /// Reports an invalid row. Throws UserError when writing, DataError when reading. Requires isValidating().
  [[noreturn]] virtual void refuse(const std::string& what) const;

 protected:
  /// Returns an empty string that lives as long as the visitor.
  std::string& scratch() { return scratch_.emplace_back(); }

 private:
  std::deque<std::string> scratch_;
};

}  // namespace urban_nav_store
