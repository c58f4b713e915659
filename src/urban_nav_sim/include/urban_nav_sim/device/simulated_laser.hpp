// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_sim/device/simulated_device.hpp"

namespace urban_nav_sim {

/// A scan of a session: 181 ranges, m (not finite: open air), and reflectivities, 0...255.
struct LaserReading {
  double time = 0.0;  ///< s since the begin of the session, first beam
  std::vector<float> ranges;
  std::vector<float> reflectivities;
};

/// An LMS291-S14 after power-on: 9 600 baud, on request. Answers telegrams, changes its line rate, streams ranges with
/// reflectivities (C4h) at 500 000 baud.
class SimulatedLaser : public SimulatedDevice {
 public:
  SimulatedLaser(std::vector<LaserReading> readings, const DeviceOptions& options);

 private:
  void takeByte(std::uint8_t byte) override;
  bool measure(double t) override;
  void boot() override;
  void skipGap();
  void answer(const DeviceBytes& payload);
  void answerMode(const DeviceBytes& payload);
  void reply(DeviceBytes payload);

  std::vector<LaserReading> readings_;
  std::size_t next_ = 0;
  std::int64_t sequence_ = 0, counter_ = 0;
  DeviceBytes pending_, configuration_;
  bool streams_ = false, installation_ = false, with_reflectivities_ = true, restarted_ = false, gap_done_ = false;
};

}  // namespace urban_nav_sim
