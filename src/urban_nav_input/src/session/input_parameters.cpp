// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/input_parameters.hpp"

namespace urban_nav_input {

using urban_nav_core::Table;

InputParameters::InputParameters() { inputTable().setDefaults(*this); }

const Table<InputParameters>& inputTable() {
  using P = InputParameters;
  static const Table<P> table(
      "input", urban_nav_core::withMotionInput<P>(
                   {{"right_delay",
                     &P::right_delay,
                     "ms",
                     0.0,
                     -1000.0,
                     1000.0,
                     {},
                     "how much later the right images of a bag are stamped than the left ones, though they are exposed "
                     "together; it is taken from their stamps",
                     "docs/files.md"}}));
  return table;
}

}  // namespace urban_nav_input
