// SPDX-License-Identifier: BSD-3-Clause
#include "icp/refine.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"

namespace urban_nav_registration {

namespace {

constexpr double kLeastSigmaShare =
    0.04;  // of the voxel: 1 cm for 0.25 m, the accuracy of outdoor lasers (LMS 291: 1 cm)

constexpr double kDamping =
    5e-4;  // of the sum over the three directions; a direction counts as constrained above 1e-2 (observability.hpp)
constexpr double kRelaxation =
    1.8;  // of a step: the reweighted quadratic is twice as stiff as the Cauchy cost (1.9 times for Gaussian residuals
          // of its scale), which it bounds from above, so that any factor below 2 decreases the cost
constexpr double kRest = 2e-4;        // m, change of the planes' distances at convergence
constexpr double kCoarseRest = 5e-3;  // of the reach, before the last step

constexpr std::size_t kEnough =
    3000;  // maximum number of surfels, except at the last level: five times the voxels of a scan in a street

std::vector<Surfel> thinned(const std::vector<Surfel>& surfels, float edge) {
  CellTable table(surfels.size() / 4 + 16);
  std::vector<Surfel> chosen;
  for (const Surfel& surfel : surfels) {
    if (!(surfel.planarity > 0.0F)) continue;
    const std::uint32_t cell = table.insert(toKey(toCell(surfel.mean, 1.0F / edge)));
    if (cell == chosen.size()) chosen.push_back(surfel);
    else if (surfel.planarity > chosen[cell].planarity) chosen[cell] = surfel;
  }
  return chosen;
}

}  // namespace

Target::Target(const Surfels& surfels, double coarsest) {
  const double finest = 2.0 * static_cast<double>(surfels.voxel);
  std::vector<double> reaches;
  for (double reach = std::max(coarsest, finest); reach > 1.4 * finest; reach *= 0.5) reaches.push_back(reach);
  reaches.push_back(finest);
  std::shared_ptr<const SurfelIndex> finer;
  for (auto reach = reaches.rbegin(); reach != reaches.rend(); ++reach) {
    finer = std::make_shared<const SurfelIndex>(surfels.all, static_cast<float>(*reach), finer);
    steps_.insert(steps_.begin(), finer);
  }
}

Source::Source(const Surfels& surfels, const Target& target) {
  for (const auto& index : target.steps()) {
    float edge = 0.5F * index->reach();
    steps_.push_back(thinned(surfels.all, edge));
    while (steps_.back().size() > kEnough) steps_.back() = thinned(steps_.back(), edge *= 1.5F);
  }
  steps_.push_back({});
  for (const Surfel& surfel : surfels.all)
    if (surfel.planarity > 0.0F) steps_.back().push_back(surfel);
}

Refined refine(const Source& source, const Target& target, const Pose& start, std::size_t first, std::size_t end,
               int iterations) {
  Refined refined;
  refined.T_target_source = start;
  const std::size_t steps = source.steps().size();
  const double finest = static_cast<double>(target.steps().back()->reach());
  for (std::size_t step = std::min(first, steps - 1); step < std::min(end, steps); ++step) {
    const bool last = step + 1 == steps;
    const SurfelIndex& index = *target.steps()[std::min(step, target.steps().size() - 1)];
    const double reach = static_cast<double>(index.reach());
    Matcher matcher(source.steps()[step], index);
    for (int i = 0; i < iterations; ++i) {
      matcher.match(refined.T_target_source, refined.matches);
      refined.sigma = std::max(computeSpread(refined.matches), 0.5 * kLeastSigmaShare * finest);
      const NormalEquations equations = sumUp(refined.matches, refined.sigma);
      ++refined.iterations;
      // Damping keeps undetermined directions from drifting with the noise of the normals; constrained ones are twenty
      // times stiffer.
      Matrix6d H = equations.H;
      const double scale = std::max(H(0, 0) + H(1, 1) + H(2, 2), 1e-12);
      const double turn = std::max(H(3, 3) + H(4, 4) + H(5, 5), 1e-12);
      H.diagonal().head<3>().array() += kDamping * scale;
      H.diagonal().tail<3>().array() += kDamping * turn;
      const Vector6d d = -urban_nav_core::solveByLdlt<6, 1>(H, equations.b);
      refined.usable = equations.weight > 5.0 && d.allFinite();
      if (!refined.usable) break;
      refined.T_target_source = boxPlus(refined.T_target_source, kRelaxation * d);
      refined.last_step = std::sqrt(std::max(0.0, d.dot(equations.H * d)) / scale);
      if (refined.last_step < (last ? kRest : kCoarseRest * reach)) break;
    }
  }
  return refined;
}

}  // namespace urban_nav_registration
