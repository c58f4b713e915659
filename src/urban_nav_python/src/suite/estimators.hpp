// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace urban_nav_python {

/// Adds Vo and Relaxation, the estimators for a loop of one's own.
void addEstimators(pybind11::module_& module);

/// Adds StoreReader.
void addStore(pybind11::module_& module);

}  // namespace urban_nav_python
