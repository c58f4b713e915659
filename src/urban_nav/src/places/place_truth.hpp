// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "places/place_query.hpp"

namespace urban_nav {

/// Where each image of a query was taken, and how near two of them show the same place.
struct PlaceTruth {
  std::vector<std::optional<Eigen::Vector3d>>
      positions;            ///< per row of the query; nullopt if the truth does not reach it
  double radius = 7.5;      ///< nearer: the same place
  double elsewhere = 10.0;  ///< farther: another place; between, neither counts
  std::string unit = "m";
};

/// Reads the truth at `path` for the rows of a query: a CSV with columns image and position (one row per image, in
/// their order; positions in units of images: the same within 3, elsewhere beyond 20), or a TUM trajectory. `radius`:
/// as given by the user; nullopt: 3 for a CSV, 7.5 m for a trajectory. Throws UserError with file and line if it is
/// neither, or of another length.
PlaceTruth readPlaceTruth(const std::string& path, const PlaceQuery& query, const std::optional<double>& radius);

/// Figures of a query against the truth.
struct PlaceScore {
  std::size_t revisits = 0;  ///< images with an earlier place of the query outside the mask within the radius
  std::size_t first = 0;     ///< of these, with a right place as the likeliest
  std::size_t found = 0;     ///< of these, above every wrong match: recall at 100 % precision
  std::size_t sure = 0;      ///< matches above 0.99 that are right or wrong
  std::size_t sure_right = 0;
  std::size_t nearly = 0;  ///< matches above 0.9 up to 0.99 that are right or wrong
  std::size_t nearly_right = 0;
  struct RecallPoint {
    double probability = 0.0, precision = 1.0, recall = 0.0;
  };
  std::vector<RecallPoint> curve;  ///< precision and recall by descending probability
};

/// `mask`: as the query used it, ns.
PlaceScore scorePlaces(const PlaceQuery& query, const PlaceTruth& truth, urban_nav_core::StampNs mask);

}  // namespace urban_nav
