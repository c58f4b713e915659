// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "calibration/term_equations.hpp"
#include "calibration/view_motion.hpp"
#include "urban_nav_core/image/pyramid.hpp"

namespace laser_mapper {

/// A sample of the map that a view shows, by their indices.
struct HeadSighting {
  std::uint32_t point = 0, view = 0;
};

/// Images of a head of cameras, and what they show of the map.
struct HeadImages {
  std::vector<MountedView> views;
  std::vector<urban_nav_core::Pyramid> pyramids;  ///< of the views, kHeadLevels each; empty ones are not used
  std::vector<Eigen::Vector3d> points, normals;   ///< m, in the map; unit
  std::vector<HeadSighting> sightings;            ///< by point, then view
};
constexpr int kHeadLevels = 4;

/// Fits the terms of a head of cameras to its images: the brightness of a point, less the exposure of each image, must
/// be the same in all views. How the brightness varies along the surface is what the views say on average: that of one
/// view is so noisy that views which do not differ would seem to tell something. Cubes of 2 m of the map are its
/// places; a fifth of them is held out. The result does not depend on the number of threads. Not thread-safe.
class HeadFit {
 public:
  /// References must outlive the fit. `centre`: of the head, in base_link.
  HeadFit(const HeadImages& images, const urban_nav_core::Trajectory& T_map_base,
          const urban_nav_core::Vector3d& centre);

  /// Estimates the terms in `wanted`; the others are zero. Without terms if no point is seen by several views.
  TermEstimate estimate(const std::vector<bool>& wanted);

  /// Spread of the brightness of points over their views in the held-out places, as a share of it.
  struct HeldOut {
    std::size_t places = 0;
    double stated = 0.0, calibrated = 0.0;
    bool improves = false;  ///< beyond chance
  };
  /// Compares the stated calibration with the last estimate.
  HeldOut compareHeldOut();
  /// Returns the number of places that the last estimate rests on.
  std::size_t places() const { return equations_places_; }

 private:
  /// What a view shows of a point at some terms.
  struct Row {
    float brightness = 0.0F;  ///< logarithm
    bool is_seen = false;
    std::array<float, 2> texture{};  ///< slope of the brightness along two axes of the surface, per m
    /// How far what the view shows moves along these axes, m per s, m and rad: two rows.
    std::array<float, 2 * kCalibrationTerms> shifts{};
  };
  struct PlaceSpread;

  std::vector<Row> rowsAt(const TermVector& terms, int level) const;
  void estimateExposures(const std::vector<Row>& rows);
  TermEquations linearise(std::vector<Row> rows);
  std::vector<PlaceSpread> spreadsAt(const TermVector& terms);
  template <typename Visit>
  void forEachPoint(const std::vector<Row>& rows, bool held_out, const Visit& visit) const;

  const HeadImages& images_;
  const urban_nav_core::Trajectory& T_map_base_;
  const urban_nav_core::Vector3d centre_;
  std::vector<std::uint32_t> place_of_;    ///< of each point
  std::vector<std::uint8_t> is_held_out_;  ///< of each place
  std::vector<float> exposures_;           ///< of each view: logarithm
  TermVector terms_ = TermVector::Zero();
  std::size_t equations_places_ = 0;
};

}  // namespace laser_mapper
