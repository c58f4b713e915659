// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "laser_mapper/parameters.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/store.hpp"

namespace laser_mapper {

/// Terms of a laser's calibration error: delay of its stamps (s), and translation (m) and rotation (rad) relative to
/// its extrinsics, in the axes of its frame according to them.
enum class CalibrationTerm { Delay, ShiftX, ShiftY, ShiftZ, TurnX, TurnY, TurnZ };
constexpr int kCalibrationTerms = 7;

/// Estimate of one term: stamps are late by `value`, or T_base_laser = T_stated * (turn, shift) with these values.
struct CalibrationEstimate {
  double value = 0.0;        ///< s, m or rad
  double sigma = 0.0;        ///< standard deviation, same unit
  bool constrained = false;  ///< the session determines it better than the prior
  double adopted = 0.0;      ///< value used by the map; 0: as stated
};

/// Terms of a laser or of the head of the panoramic cameras.
struct DeviceCalibration {
  std::string frame;
  std::array<CalibrationEstimate, kCalibrationTerms> terms;

  const CalibrationEstimate& at(CalibrationTerm term) const { return terms[static_cast<std::size_t>(term)]; }
  bool isAdopted() const;
};

/// Delay and mounting of the lasers of one session against its trajectory.
struct CalibrationResult {
  std::vector<DeviceCalibration> lasers;              ///< by frame
  std::vector<std::string> unconstrained;             ///< directions, for users: "laser_left: shift along its z axis"
  std::size_t places = 0;                             ///< planar places measured more than once that were used
  std::size_t held_out = 0;                           ///< places excluded from the estimate, for validation
  double stated_spread = 0.0;                         ///< m, mean over the held-out places with the stated calibration
  double calibrated_spread = 0.0;                     ///< m, with the estimate
  double improvement = 0.0, improvement_sigma = 0.0;  ///< m, mean difference of the two and its standard error
  bool is_significant = false;                        ///< some terms differ significantly from zero
  bool improves = false;                              ///< held-out places agree significantly better

  bool isAdopted() const { return is_significant && improves; }
};

/// Estimates delay and mounting of the lasers of a session from planar places measured more than once: beams of
/// different times and lasers must end on one plane. Terms without a significant effect keep their stated values; no
/// term is adopted unless held-out places agree better. `odometry`: its covariances bound errors of the trajectory;
/// null: 1 mm and 0.3 mrad per second. Uses the extrinsics of the store, not an adopted calibration. Deterministic.
/// Throws the errors of the store.
CalibrationResult calibrateLasers(const Parameters& parameters, urban_nav_store::Store& store,
                                  const urban_nav_store::SessionId& session,
                                  const urban_nav_core::Trajectory& T_map_base,
                                  const urban_nav_core::OdometryChain* odometry);

/// Stores the adopted terms of a session's lasers for all stages, or removes them if none is adopted; adopted terms of
/// the panoramas are kept. LaserMap::render() renders chunks with another calibration again.
void storeCalibration(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                      const CalibrationResult& calibration);
/// Removes the adopted calibration of a session: all stages use its extrinsics and stamps.
void forgetCalibration(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace laser_mapper
