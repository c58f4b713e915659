// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/columns.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "blocks/matrix_bytes.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::Archive;
using urban_nav_core::ConsideredConstant;
using urban_nav_core::ConsideredConstants;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

void Columns::refuse(const std::string& what) const { throw std::logic_error("not validated: " + what); }

void Columns::flag(const char* name, bool& value) {
  std::int64_t number = value ? 1 : 0;
  integer(name, number);
  if (!isReading()) return;
  if (number != 0 && number != 1) refuse(std::string(name) + " is neither 0 nor 1");
  value = number == 1;
}

void Columns::pose(Pose& value) {
  constexpr const char* kNames[] = {"x", "y", "z", "qx", "qy", "qz", "qw"};
  double v[7] = {value.t().x(), value.t().y(), value.t().z(), value.q().x(),
                 value.q().y(), value.q().z(), value.q().w()};
  for (int i = 0; i < 7; ++i) real(kNames[i], v[i]);
  if (!isValidating()) return;
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(std::abs(q.norm() - 1.0) <= 0.01)) refuse("a quaternion is not of unit length");
  if (isReading()) value = Pose(q, {v[0], v[1], v[2]});
}

void Columns::matrix6(const char* name, Matrix6d& value) {
  if (isValidating() && !isReading() && !value.allFinite()) refuse(std::string(name) + " is not finite");
  std::string& bytes = scratch();
  if (!isReading()) bytes = matrixBytes(value);
  blob(name, bytes);
  if (isReading() && !parseMatrix(bytes, value)) refuse(std::string(name) + " is not a matrix of finite numbers");
}

void Columns::constants(const char* name, ConsideredConstants& values) {
  std::string& bytes = scratch();
  const auto are_finite = [&values] {
    return std::all_of(values.begin(), values.end(), [](const ConsideredConstant& each) { return isFinite(each); });
  };
  if (isValidating() && !isReading() && !are_finite()) refuse(std::string(name) + " are not finite");
  if (!isReading() && !values.empty()) {
    Archive writer;
    writer(values);
    bytes = writer.take();
  }
  blob(name, bytes);
  if (!isReading()) return;
  values.clear();
  if (bytes.empty()) return;
  try {
    Archive reader(bytes, name);
    reader(values);
    reader.finish();
  } catch (const urban_nav_core::DataError&) {
    refuse(std::string(name) + " cannot be read");
  }
  if (!are_finite()) refuse(std::string(name) + " are not finite");
}

}  // namespace urban_nav_store
