// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_store/session.hpp"

namespace urban_nav_store {

/// Raw laser scans, so that a map can be made again without the recording: in compressed blocks of one second of stamps,
/// lossless. The blocks do not depend on when commits came between.
class ScanStore {
 public:
  virtual ~ScanStore() = default;

  /// In the order of time, for the sake of speed alone: one from an earlier second makes its block be read and written
  /// again. UserError for numbers that are not finite. A scan with the stamp of another of this laser replaces it.
  virtual void put(const SessionId& session, const std::string& laser, const urban_nav_core::Scan& scan) = 0;

  /// Frame names, sorted.
  virtual std::vector<std::string> lasers(const SessionId& session) const = 0;
  virtual std::int64_t count(const SessionId& session, const std::string& laser) const = 0;
  /// Scans with from <= stamp <= to in order of time, one block in memory at a time.
  virtual void forEach(const SessionId& session, const std::string& laser, urban_nav_core::StampNs from,
                       urban_nav_core::StampNs to,
                       const std::function<void(const urban_nav_core::Scan&)>& take) const = 0;
};

}  // namespace urban_nav_store
