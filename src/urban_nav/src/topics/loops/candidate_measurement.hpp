// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "loop_metric/parameters.hpp"
#include "loop_metric/place/stored_place_data.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_registration/keyframe/mounted_camera.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Keyframes and scans of several sessions, each in one of several stores. Not thread-safe.
class SeveralStores {
 public:
  /// `paths`: of stores without a common session, or with the same rows of it. Throws the errors of urban_nav_store.
  explicit SeveralStores(const std::vector<std::string>& paths);
  ~SeveralStores();
  SeveralStores(const SeveralStores&) = delete;
  SeveralStores& operator=(const SeveralStores&) = delete;

  const urban_nav_store::KeyframeStore& keyframes() const;
  const urban_nav_store::ScanStore& scans() const;

 private:
  class Keyframes;
  class Scans;
  std::vector<std::unique_ptr<urban_nav_store::Store>> stores_;
  std::unique_ptr<Keyframes> keyframes_;
  std::unique_ptr<Scans> scans_;
};

/// Stores and settings for measuring candidates for closures.
struct CandidateMeasurer {
  std::vector<std::string> stores;                  ///< paths
  loop_metric::StoredPlaceData::Sessions sessions;  ///< of all stores, by their names in candidates
  loop_metric::Parameters parameters;
  urban_nav_registration::MountedCamera camera;  ///< camera to which the views of all sessions are converted
};

struct MeasuredCandidates {
  std::vector<urban_nav_core::MetricClosure> closures;  ///< one for each candidate, in their order
  std::vector<double> ms;                               ///< time of each
};

/// Measures the transform of each candidate independently. `progress`: called with the number of candidates done. Runs
/// on several threads; the closures do not depend on their number.
MeasuredCandidates measureCandidates(const CandidateMeasurer& measurer,
                                     const std::vector<urban_nav_core::MetricClosure>& candidates,
                                     const std::function<void(std::size_t)>& progress);

}  // namespace urban_nav
