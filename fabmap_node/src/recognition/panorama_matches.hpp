// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fabmap_node/recognition/second_look.hpp"

namespace fabmap_node {

/// Returns the sum over all elements of the difference of their levels, 0 ... 128.
int levelDistance(const PanoramaFeature& a, const PanoramaFeature& b);

/// Match of two features of panoramas, by their directions.
struct PanoramaMatch {
  Eigen::Vector2f a, b;

  Eigen::Vector2f displacement() const { return b - a; }
};

/// Returns the features of two panoramas that are mutual nearest neighbours by a clear margin, among those at nearly
/// the same elevation. Requires sorted features.
std::vector<PanoramaMatch> matchPanoramas(const ComparedFeatures& a, const ComparedFeatures& b);

/// secondLook() of two panoramas with the same number of cameras.
LookAgreement comparePanoramas(const ComparedFeatures& a, const ComparedFeatures& b);

}  // namespace fabmap_node
