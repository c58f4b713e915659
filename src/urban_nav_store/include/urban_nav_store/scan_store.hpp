// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_store/session.hpp"

namespace urban_nav_store {

/// Raw laser scans, from which a map can be rebuilt without the recording. Lossless, in compressed blocks of one second
/// of stamps. The blocks do not depend on the times of commits.
class ScanStore {
 public:
  virtual ~ScanStore() = default;

  /// Adds a scan, replacing one of the same laser and stamp. Fastest in order of time: a scan from an earlier second
  /// rewrites its block. Throws UserError for numbers that are not finite.
  virtual void put(const SessionId& session, const std::string& laser, const urban_nav_core::Scan& scan) = 0;

  /// Returns frame names, sorted.
  virtual std::vector<std::string> lasers(const SessionId& session) const = 0;
  virtual std::int64_t count(const SessionId& session, const std::string& laser) const = 0;
  /// Calls `take` for scans with from <= stamp <= to in order of time; holds a few blocks in memory.
  virtual void forEach(const SessionId& session, const std::string& laser, urban_nav_core::StampNs from,
                       urban_nav_core::StampNs to,
                       const std::function<void(const urban_nav_core::Scan&)>& take) const = 0;
};

}  // namespace urban_nav_store
