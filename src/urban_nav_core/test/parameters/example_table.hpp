// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core {

/// A table with a row of each type.
struct Example {
  int window;
  double noise;
  bool robust;
  std::string forget;
  std::string switch_;
  std::string name;

  Example();
};

inline const Table<Example>& exampleTable() {
  using P = Example;
  static const Table<Example> rows(
      "stage",
      {
          {"window", &P::window, "frames", 10, 1, 100000, {}, "Poses kept.", "section 2.2"},
          {"noise", &P::noise, "px", 0.3, 0.001, 5.0, {}, "Standard deviation of a pixel | of any.", ""},
          {"robust", &P::robust, "", true, false, false, {}, "Robust kernel.", ""},
          {"forget", &P::forget, "", "schur", false, false, {"schur", "delete"}, "What becomes of old poses.", ""},
          {"switch", &P::switch_, "", "on", false, false, {"on", "off"}, "A word that YAML takes for a boolean.", ""},
          {"name", &P::name, "", "", false, false, {}, "Any text.", ""},
      });
  return rows;
}

inline Example::Example() { exampleTable().setDefaults(*this); }

}  // namespace urban_nav_core
