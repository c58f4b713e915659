// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace urban_nav_sim {

/// Delay from a measurement to the arrival of its first byte.
struct DelayModel {
  enum class Kind { Constant, Exponential, Uniform, Batch } kind = Kind::Constant;
  double min_ms = 0.0, mean_ms = 0.0,
         max_ms = 0.0;  ///< mean: of the exponential; batch: max is the period of the reads

  /// "exponential:MIN:MEAN:MAX", "uniform:MIN:MAX" or "batch:MS", in ms. `least`: ms, the least delay of a batch.
  /// Throws UserError; `option`: source of the text.
  static DelayModel parse(const std::string& text, double least, const std::string& option = "--delay");
  /// Draws the delay beyond min_ms, ms; `arrival_ms`: undelayed arrival of the frame, for batches.
  double drawExcess(std::mt19937_64& random, double arrival_ms) const;
};

/// Clock of a device relative to that of the host: "OFFSET_S:PPM".
struct DeviceClock {
  double offset = 0.0;  ///< s
  double skew = 0.0;    ///< device seconds per host second minus 1

  /// Throws UserError; `option`: source of the text.
  static DeviceClock parse(const std::string& text, const std::string& option = "--clock");
};

}  // namespace urban_nav_sim
