// SPDX-License-Identifier: BSD-3-Clause
#include "schema/row_columns.hpp"

#include <cmath>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::UserError;

void CheckingColumns::addKey(const char* name, const std::string& value) {
  if (columns_ < table_.keys) key_ += (columns_ > 0 ? ", " : "") + std::string(name) + "=" + value;
  ++columns_;
}

void CheckingColumns::real(const char* name, double& value) {
  ++columns_;
  if (!std::isfinite(value)) refuse(std::string(name) + " is not finite");
}

void CheckingColumns::refuse(const std::string& what) const {
  throw UserError(connection_.name(), "the row of " + table_.name + " with " + key_ + " is invalid: " + what,
                  "finite numbers, quaternions of length 1");
}

bool ReadingColumns::isStored(const char* name) {
  const std::vector<Column>& columns = reader_.table().columns;
  if (next_ == columns.size() || columns[next_].name != name) return false;
  ++next_;
  return true;
}

void ReadingColumns::text(const char* name, std::string& value) {
  if (isStored(name)) value = reader_.text();
}
void ReadingColumns::integer(const char* name, std::int64_t& value) {
  if (isStored(name)) value = reader_.integer();
}
void ReadingColumns::real(const char* name, double& value) {
  if (isStored(name)) value = reader_.real();
}
void ReadingColumns::blob(const char* name, std::string& value) {
  if (isStored(name)) value = reader_.blob();
}

void KeyColumns::text(const char*, std::string& value) {
  if (next_ < keys_) {
    std::string& copy = scratch();
    copy = value;
    statement_.bind(static_cast<int>(next_), copy);
  }
  ++next_;
}

void KeyColumns::integer(const char*, std::int64_t& value) {
  if (next_ < keys_) statement_.bind(static_cast<int>(next_), value);
  ++next_;
}

}  // namespace urban_nav_store
