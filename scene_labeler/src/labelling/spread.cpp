// SPDX-License-Identifier: BSD-3-Clause
#include "labelling/spread.hpp"

#include <algorithm>
#include <cmath>

#include "scene_labeler/model/calibration.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace scene_labeler {
namespace {

using urban_nav_registration::CellTable;

constexpr float spread_per_m = 1.0F / 1.6F;
constexpr double least_shown = 5.0;    // points around
constexpr double share_of_any = 0.02;  // of a class that no shown point around has, together with all others

}  // namespace

void spreadToHidden(const std::vector<Eigen::Vector3f>& points, const std::vector<std::uint8_t>& is_shown,
                    const std::vector<std::uint8_t>& is_hidden, std::size_t classes, std::vector<float>& logs) {
  if (points.empty()) return;
  const float limit = static_cast<float>(urban_nav_registration::kFarthestCell) / spread_per_m;
  CellTable table(points.size() / 64 + 16);
  std::vector<double> sums;  // cube by cube: number of points, then the sum of probabilities of each class
  const std::size_t stride = classes + 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_shown[i] == 0 || !points[i].allFinite() || !(points[i].cwiseAbs().maxCoeff() < limit)) continue;
    const std::size_t cube =
        table.insert(urban_nav_registration::toKey(urban_nav_registration::toCell(points[i], spread_per_m)));
    if (sums.size() <= cube * stride) sums.resize((cube + 1) * stride, 0.0);
    sums[cube * stride] += 1.0;
    for (std::size_t k = 0; k < classes; ++k)
      sums[cube * stride + 1 + k] += std::exp(static_cast<double>(logs[i * classes + k]));
  }
  if (sums.empty()) return;
  std::vector<double> around(stride);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_hidden[i] == 0 || !points[i].allFinite() || !(points[i].cwiseAbs().maxCoeff() < limit)) continue;
    const std::uint64_t key = urban_nav_registration::toKey(urban_nav_registration::toCell(points[i], spread_per_m));
    std::fill(around.begin(), around.end(), 0.0);
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int h = -1; h <= 1; ++h) {
          const std::uint32_t cube = table.find(urban_nav_registration::keyBeside(key, {h, j, k}));
          if (cube == CellTable::none) continue;
          for (std::size_t n = 0; n < stride; ++n) around[n] += sums[cube * stride + n];
        }
    if (around[0] < least_shown) continue;
    for (std::size_t k = 0; k < classes; ++k)
      logs[i * classes + k] += static_cast<float>(std::log(around[1 + k] / around[0] + share_of_any));
    normaliseLogs(logs.data() + i * classes, classes);
  }
}

}  // namespace scene_labeler
