// SPDX-License-Identifier: BSD-3-Clause
#include "input/input_parameters.hpp"

namespace urban_nav {

using urban_nav_core::Table;

InputParameters::InputParameters() { inputTable().setDefaults(*this); }

const Table<InputParameters>& inputTable() {
  static const Table<InputParameters> table("input", urban_nav_core::withMotionInput<InputParameters>({}));
  return table;
}

}  // namespace urban_nav
