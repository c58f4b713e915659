// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/parameters.hpp"

#include <cstdint>

namespace dense_stereo {

using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "dense_stereo",
      {
          {"method", &P::method, "", std::string("sgm"), false, false, {"sgm", "paper"},
           "Semi-global matching with aligned slanted windows, or the local matcher of the paper (for comparison).",
           "section 6.2; Hirschmueller 2008"},
          {"disparities", &P::disparities, "px", std::int64_t{64}, std::int64_t{16}, std::int64_t{240}, {},
           "Disparities searched, from 0, rounded up to a multiple of 16. Nearer surfaces are not matched.",
           "section 6.2"},
          {"min_component", &P::min_component, "px", std::int64_t{100}, std::int64_t{0}, std::int64_t{1000000}, {},
           "Connected patches of similar disparity with fewer pixels than this are removed.", "section 6.2"},
          {"max_sigma", &P::max_sigma, "px", 2.0, 0.05, 100.0, {},
           "Disparities with a larger standard deviation are invalid.", "dense_stereo/bench, accuracy"},
      });
  return rows;
}
// clang-format on

}  // namespace dense_stereo
