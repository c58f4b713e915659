// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <string_view>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_python {

/// Returns a text of the suite, which may hold names of files in any encoding.
inline pybind11::object toText(std::string_view text) {
  PyObject* decoded = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape");
  if (decoded == nullptr) throw pybind11::error_already_set();
  return pybind11::reinterpret_steal<pybind11::object>(decoded);
}

/// Sets the Python error urban_nav.Error with the text and the exit status of the command.
inline void setError(const char* text, int status) {
  const pybind11::object type = pybind11::module_::import("urban_nav._error").attr("Error");
  const pybind11::object error = type(toText(text), status);
  PyErr_SetObject(type.ptr(), error.ptr());
}

/// Errors of the suite that leave a function of this module become urban_nav.Error: status 2 for the user's mistakes, 1
/// for unsuitable data.
inline void registerErrors() {
  pybind11::register_local_exception_translator([](std::exception_ptr thrown) {
    if (!thrown) return;
    try {
      std::rethrow_exception(thrown);
    } catch (const urban_nav_core::UserError& error) {
      setError(error.what(), 2);
    } catch (const urban_nav_core::DataError& error) {
      setError(error.what(), 1);
    }
  });
}

}  // namespace urban_nav_python
