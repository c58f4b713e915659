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

/// What a calibration can get wrong about a laser: the delay of its stamps (s), and the shift (m) and turn (rad) of the
/// laser relative to where the extrinsics put it, in the axes of its frame as they state it.
enum class CalibrationTerm { Delay, ShiftX, ShiftY, ShiftZ, TurnX, TurnY, TurnZ };
constexpr int kCalibrationTerms = 7;

/// One term: stamps are late by `value`, or T_base_laser = T_stated * (turn, shift) by the values.
struct CalibrationEstimate {
  double value = 0.0;        ///< s, m or rad
  double sigma = 0.0;        ///< standard deviation, same unit
  bool constrained = false;  ///< the session says more about it than that it is small
  double adopted = 0.0;      ///< that the map uses; 0: as stated
};

/// The terms of a laser or of the head of the panoramic cameras.
struct DeviceCalibration {
  std::string frame;
  std::array<CalibrationEstimate, kCalibrationTerms> terms;

  const CalibrationEstimate& at(CalibrationTerm term) const { return terms[static_cast<std::size_t>(term)]; }
  bool isAdopted() const;
};

/// Delay and mounting of the lasers of one session against its trajectory.
struct CalibrationResult {
  std::vector<DeviceCalibration> lasers;              ///< by frame
  std::vector<std::string> unconstrained;             ///< directions in words: "laser_left: shift along its z axis"
  std::size_t places = 0;                             ///< planar places measured more than once that it rests on
  std::size_t held_out = 0;                           ///< places left out, by which it is judged
  double stated_spread = 0.0;                         ///< m, mean over the held-out places with the stated calibration
  double calibrated_spread = 0.0;                     ///< m, with the estimate
  double improvement = 0.0, improvement_sigma = 0.0;  ///< m, mean difference of the two and its standard error
  bool is_significant = false;                        ///< some terms differ from zero beyond chance
  bool improves = false;                              ///< held-out places agree better, beyond chance

  bool isAdopted() const { return is_significant && improves; }
};

/// Estimates delay and mounting of the lasers of a session by the sharpness of planar places that it measured more than
/// once: beams of different times and lasers must end on one plane. Terms whose effect is not significant keep their
/// stated values; nothing is adopted if places left out of the estimate do not agree better. `odometry`: its
/// covariances say how far the trajectory may be off; null: by 1 mm and 0.3 mrad a second. Uses the extrinsics of the
/// store, not an adopted calibration. Deterministic. Throws the errors of the store.
CalibrationResult calibrateLasers(const Parameters& parameters, urban_nav_store::Store& store,
                                  const urban_nav_store::SessionId& session,
                                  const urban_nav_core::Trajectory& T_map_base,
                                  const urban_nav_core::OdometryChain* odometry);

/// Makes all stages use the adopted terms of a calibration of a session's lasers, or, with none adopted, the extrinsics
/// alone; what is adopted of the panoramas stays. Chunks rendered with another calibration are rendered again by
/// LaserMap::render().
void storeCalibration(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                      const CalibrationResult& calibration);
/// Makes all stages use the extrinsics and stamps of a session alone.
void forgetCalibration(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace laser_mapper
