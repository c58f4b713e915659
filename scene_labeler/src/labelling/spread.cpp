// SPDX-License-Identifier: BSD-3-Clause
#include "labelling/spread.hpp"

#include <algorithm>
#include <cmath>

#include "scene_labeler/model/calibration.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace scene_labeler {
namespace {

using urban_nav_registration::CellTable;

constexpr double kShareOfAny = 0.02;  // total probability of classes without a point in the surroundings

struct SpreadSettings {
  float per_m = 1.0F / 1.6F;        // inverse edge of cubes whose neighbours are the surroundings
  double least_sources = 5.0;       // least number of points around
  float own = 1.0F, around = 1.0F;  // exponents of the probabilities of the point and of its surroundings
  std::vector<std::size_t> kinds;   // classes that are hardly distinguished without an image
};

constexpr float kOwnOfKinds = 0.5F;  // exponent of a point's probabilities among those

/// Raises the probabilities of some classes, given as logarithms, to a power and preserves their sum.
void flatten(const std::vector<std::size_t>& kinds, float power, float* logs) {
  if (kinds.size() < 2) return;
  float highest = logs[kinds.front()];
  for (const std::size_t k : kinds) highest = std::max(highest, logs[k]);
  float before = 0.0F, after = 0.0F;
  for (const std::size_t k : kinds) {
    before += std::exp(logs[k] - highest);
    after += std::exp(power * (logs[k] - highest));
  }
  const float shift = std::log(before / after);
  for (const std::size_t k : kinds) logs[k] = highest + power * (logs[k] - highest) + shift;
}

void spreadLogs(const std::vector<Eigen::Vector3f>& points, const std::vector<std::uint8_t>& is_source,
                const std::vector<std::uint8_t>& is_target, std::size_t classes, const SpreadSettings& settings,
                std::vector<float>& logs) {
  if (points.empty()) return;
  const float limit = static_cast<float>(urban_nav_registration::kFarthestCell) / settings.per_m;
  CellTable table(points.size() / 64 + 16);
  std::vector<double> sums;  // per cube: number of points, then the sum of probabilities of each class
  const std::size_t stride = classes + 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_source[i] == 0 || !points[i].allFinite() || !(points[i].cwiseAbs().maxCoeff() < limit)) continue;
    const std::size_t cube =
        table.insert(urban_nav_registration::toKey(urban_nav_registration::toCell(points[i], settings.per_m)));
    if (sums.size() <= cube * stride) sums.resize((cube + 1) * stride, 0.0);
    sums[cube * stride] += 1.0;
    for (std::size_t k = 0; k < classes; ++k)
      sums[cube * stride + 1 + k] += std::exp(static_cast<double>(logs[i * classes + k]));
  }
  if (sums.empty()) return;
  std::vector<double> around(stride);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_target[i] == 0 || !points[i].allFinite() || !(points[i].cwiseAbs().maxCoeff() < limit)) continue;
    const std::uint64_t key = urban_nav_registration::toKey(urban_nav_registration::toCell(points[i], settings.per_m));
    std::fill(around.begin(), around.end(), 0.0);
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int h = -1; h <= 1; ++h) {
          const std::uint32_t cube = table.find(urban_nav_registration::keyBeside(key, {h, j, k}));
          if (cube == CellTable::kNone) continue;
          for (std::size_t n = 0; n < stride; ++n) around[n] += sums[cube * stride + n];
        }
    if (around[0] < settings.least_sources) continue;
    flatten(settings.kinds, kOwnOfKinds, logs.data() + i * classes);
    for (std::size_t k = 0; k < classes; ++k)
      logs[i * classes + k] = settings.own * logs[i * classes + k] +
                              settings.around * static_cast<float>(std::log(around[1 + k] / around[0] + kShareOfAny));
    normaliseLogs(logs.data() + i * classes, classes);
  }
}

}  // namespace

void spreadToHidden(const std::vector<Eigen::Vector3f>& points, const std::vector<std::uint8_t>& is_shown,
                    const std::vector<std::uint8_t>& is_hidden, const std::vector<SceneClass>& classes,
                    std::vector<float>& logs) {
  SpreadSettings settings;
  for (std::size_t k = 0; k < classes.size(); ++k)
    if (isKindOfGround(classes[k])) settings.kinds.push_back(k);
  spreadLogs(points, is_shown, is_hidden, classes.size(), settings, logs);
}

void smoothLabels(const std::vector<Eigen::Vector3f>& points, const std::vector<std::uint8_t>& is_labelled,
                  std::size_t classes, std::vector<float>& logs) {
  spreadLogs(points, is_labelled, is_labelled, classes, {2.0F, 5.0, 0.7F, 0.7F, {}}, logs);
}

}  // namespace scene_labeler
