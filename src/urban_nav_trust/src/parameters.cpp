// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/parameters.hpp"

namespace urban_nav_trust {

using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "trust",
      {
          {"false_alarm", &P::false_alarm, "", 1e-5, 1e-12, 0.5, {},
           "Probability that a test fails although both measurements are consistent.",
           "docs/derivations/trust.md", {}, urban_nav_core::Audience::Experts},
          {"unexplained_drift", &P::unexplained_drift, "%", 5.0, 0.0, 100.0, {},
           "Growth of the standard deviation of positions per distance travelled while a test fails.",
           "docs/derivations/trust.md", {}, urban_nav_core::Audience::Experts},
      });
  return rows;
}
// clang-format on

}  // namespace urban_nav_trust
