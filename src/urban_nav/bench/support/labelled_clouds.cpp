// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "cloud_drive.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace urban_nav::bench {

using scene_labeler::SceneClass;
using urban_nav_registration::CellTable;

namespace {

// Relief that the simulator's ground lacks. Lawns are mown to 3 to 8 cm, verges and meadows grow to 20 cm; gravel has
// grains up to 3 cm and tyre marks.
constexpr float kShortestGrass = 0.03F, kLongestGrass = 0.2F;  // m
constexpr float kLeastGravel = 0.005F, kMostGravel = 0.025F;   // m, standard deviation
constexpr float kFlattestBeam = 0.1F;                          // sine of the elevation, of the move along a beam
constexpr float kMostJitter = 0.04F;                           // m: errors of the poses within a cloud
constexpr float kFacadePerM = 2.5F;                            // cubes of 0.4 m
constexpr double kFacadeShare = 0.5;
constexpr std::size_t kSecond = 10;  // sweeps

/// Random numbers that are the same with every standard library.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}
  float uniform(float low, float high) {
    return low + (high - low) * static_cast<float>(static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  float normal() {  // sum of twelve uniform numbers
    float sum = -6.0F;
    for (int i = 0; i < 12; ++i) sum += uniform(0.0F, 1.0F);
    return sum;
  }

 private:
  std::mt19937_64 random_;
};

/// Moves a return to the place where its beam meets a surface that is higher by `height`.
Eigen::Vector3f raise(const Eigen::Vector3f& point, const Eigen::Vector3f& origin, float height) {
  const Eigen::Vector3f back = (origin - point).normalized();
  return point + height / std::max(back.z(), kFlattestBeam) * back;
}

/// Cubes in which most returns are of walls.
class Facades {
 public:
  explicit Facades(const DriveReturns& returns) {
    for (std::size_t i = 0; i < returns.points.size(); ++i) {
      const std::uint32_t cube = table_.insert(keyOf(returns.points[i]));
      if (cube == counts_.size()) counts_.push_back({0.0, 0.0});
      counts_[cube][0] += 1.0;
      const auto label = static_cast<SceneClass>(returns.classes[i]);
      if (withOneWall(label) == SceneClass::Wall) counts_[cube][1] += 1.0;
    }
  }
  bool hold(const Eigen::Vector3f& point) const {
    double all = 0.0, walls = 0.0;
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const std::uint32_t cube = table_.find(urban_nav_registration::keyBeside(keyOf(point), {i, j, k}));
          if (cube == CellTable::kNone) continue;
          all += counts_[cube][0];
          walls += counts_[cube][1];
        }
    return walls > kFacadeShare * all;
  }

 private:
  static std::uint64_t keyOf(const Eigen::Vector3f& point) {
    return urban_nav_registration::toKey(urban_nav_registration::toCell(point, kFacadePerM));
  }
  CellTable table_{1024};
  std::vector<std::array<double, 2>> counts_;
};

/// Ground as it is: one kind of lawn and of gravel for a drive.
DriveReturns withRelief(DriveReturns returns, Draws& draws) {
  const float grass = draws.uniform(kShortestGrass, kLongestGrass), gravel = draws.uniform(kLeastGravel, kMostGravel);
  for (std::size_t i = 0; i < returns.points.size(); ++i) {
    const auto label = static_cast<SceneClass>(returns.classes[i]);
    if (!isKindOfGround(label) || label == SceneClass::Paved) continue;
    const float height =
        label == SceneClass::Grass ? draws.uniform(0.0F, grass) : gravel * draws.normal();
    returns.points[i] = raise(returns.points[i], returns.origins[returns.sweeps[i]], height);
  }
  return returns;
}

/// Cloud of the sweeps from `begin` to before `end`, turned about the vertical, with errors of poses.
LabelledCloud cloudOf(const DriveReturns& returns, const std::vector<SceneClass>& labels, std::size_t begin,
                      std::size_t end, Draws& draws) {
  const float angle = draws.uniform(0.0F, 2.0F * static_cast<float>(M_PI));
  const float jitter = end - begin > 1 ? std::max(0.0F, draws.uniform(-kMostJitter, kMostJitter)) : 0.0F;
  const float cosine = std::cos(angle), sine = std::sin(angle);
  Eigen::Matrix3f R = Eigen::Matrix3f::Identity();
  R.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
  const auto first = std::lower_bound(returns.sweeps.begin(), returns.sweeps.end(), begin) - returns.sweeps.begin();
  LabelledCloud cloud;
  for (auto i = static_cast<std::size_t>(first); i < returns.points.size() && returns.sweeps[i] < end; ++i) {
    const Eigen::Vector3f error(draws.normal(), draws.normal(), draws.normal());
    cloud.scene.points.push_back(R * (returns.points[i] - returns.origins[begin]) + jitter * error);
    cloud.labels.push_back(labels[i]);
  }
  return cloud;
}

}  // namespace

std::vector<LabelledCloud> makeClouds(const CloudDrive& drive, const DriveReturns& flat) {
  std::uint64_t seed = drive.seed;
  for (const char letter : drive.name()) seed = 31 * seed + static_cast<unsigned char>(letter);
  Draws draws(seed);
  const Facades facades(flat);
  std::vector<SceneClass> labels;
  for (std::size_t i = 0; i < flat.points.size(); ++i) {
    const SceneClass label = withOneWall(static_cast<SceneClass>(flat.classes[i]));
    labels.push_back(label == SceneClass::Other && facades.hold(flat.points[i]) ? SceneClass::None : label);
  }
  const DriveReturns returns = withRelief(flat, draws);
  const std::size_t sweeps = returns.sweepCount();
  std::vector<LabelledCloud> clouds;
  if (drive.device != "lasers") {
    for (const std::size_t at : {std::size_t{1}, sweeps / 2, sweeps - 2})
      clouds.push_back(cloudOf(returns, labels, at, at + 1, draws));
    for (const std::size_t at : {std::size_t{0}, sweeps / 2})
      clouds.push_back(cloudOf(returns, labels, at, std::min(at + kSecond, sweeps), draws));
  }
  clouds.push_back(cloudOf(returns, labels, 0, sweeps, draws));
  return clouds;
}

}  // namespace urban_nav::bench
