// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

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
// Vans are 2 m high and more; lorries and buses at most 4 m high and 12 m long (Directive 96/53/EC).
constexpr float kVanHeight = 2.0F, kLargestHeight = 4.0F, kMostLengthening = 12.0F / 4.5F;
constexpr float kShareOfLarge = 0.3F;
constexpr float kLeastCar = 0.8F;  // m: less of a vehicle was seen
constexpr float kVehiclePerM = 2.0F;
constexpr std::size_t kSecond = 10;    // sweeps
constexpr float kLimitedPerM = 10.0F;  // cubes of 0.1 m
constexpr std::uint32_t kMostOfCube = 4;

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

std::pair<int, int> vehicleSquare(const Eigen::Vector3f& point) {
  return {static_cast<int>(std::floor(kVehiclePerM * point.x())),
          static_cast<int>(std::floor(kVehiclePerM * point.y()))};
}

/// Cubes in which most returns are of walls.
class Facades {
 public:
  explicit Facades(const DriveReturns& returns) {
    for (std::size_t i = 0; i < returns.points.size(); ++i) {
      const std::uint32_t cube = table_.insert(cubeKey(returns.points[i]));
      if (cube == counts_.size()) counts_.push_back({0.0, 0.0});
      counts_[cube][0] += 1.0;
      const auto label = static_cast<SceneClass>(returns.classes[i]);
      if (withOneWall(label) == SceneClass::Wall) counts_[cube][1] += 1.0;
    }
  }
  bool hold(const Eigen::Vector3f& point) const {
    const urban_nav_registration::Cell cell = urban_nav_registration::toCell(point, kFacadePerM);
    double all = 0.0, walls = 0.0;
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const std::uint32_t cube = table_.find(urban_nav_registration::toKey({cell.x + i, cell.y + j, cell.z + k}));
          if (cube == CellTable::kNone) continue;
          all += counts_[cube][0];
          walls += counts_[cube][1];
        }
    return walls > kFacadeShare * all;
  }

 private:
  static std::uint64_t cubeKey(const Eigen::Vector3f& point) {
    return urban_nav_registration::toKey(urban_nav_registration::toCell(point, kFacadePerM));
  }
  CellTable table_{1024};
  std::vector<std::array<double, 2>> counts_;
};

/// Kinds of ground and their relief in a cloud. Kinds are exchanged at random, so that they are learnt by their relief
/// and not by the layout of three worlds; what is smooth is paved more often than not.
class Ground {
 public:
  explicit Ground(Draws& draws) : draws_(draws) {
    kinds_[0] = draws.uniform(0.0F, 1.0F) < 0.85F ? SceneClass::Grass : SceneClass::DirtPath;
    for (const std::size_t smooth : {1, 2}) {
      const float draw = draws.uniform(0.0F, 1.0F), paved = smooth == 1 ? 0.8F : 0.5F;
      kinds_[smooth] = draw < paved ? SceneClass::Paved : draw < 0.9F ? SceneClass::DirtPath : SceneClass::Grass;
    }
    grass_ = draws.uniform(kShortestGrass, kLongestGrass);
    gravel_ = draws.uniform(kLeastGravel, kMostGravel);
  }
  SceneClass changeKind(SceneClass label) const {
    return isKindOfGround(label) ? kinds_[toIndex(label) - toIndex(SceneClass::Grass)] : label;
  }
  Eigen::Vector3f place(const Eigen::Vector3f& point, const Eigen::Vector3f& origin, SceneClass kind) {
    if (kind == SceneClass::Grass) return raise(point, origin, draws_.uniform(0.0F, grass_));
    return kind == SceneClass::DirtPath ? raise(point, origin, gravel_ * draws_.normal()) : point;
  }

 private:
  Draws& draws_;
  std::array<SceneClass, 3> kinds_{};  // classes of grass, paving and dirt of the simulator
  float grass_ = 0.0F, gravel_ = 0.0F;
};

/// Limits the points of a cube of 0.1 m to four, as GrowingCloud does.
class PointLimit {
 public:
  bool admits(const Eigen::Vector3f& point) {
    const std::uint32_t cube =
        table_.insert(urban_nav_registration::toKey(urban_nav_registration::toCell(point, kLimitedPerM)));
    if (cube == counts_.size()) counts_.push_back(0);
    return ++counts_[cube] <= kMostOfCube;
  }

 private:
  CellTable table_{1024};
  std::vector<std::uint32_t> counts_;
};

/// Numbers the squares of 0.5 m that vehicles touch by connected groups.
std::map<std::pair<int, int>, std::size_t> groupVehicles(const LabelledCloud& cloud) {
  std::map<std::pair<int, int>, std::size_t> group_of;
  constexpr std::size_t kNew = static_cast<std::size_t>(-1);
  for (std::size_t i = 0; i < cloud.labels.size(); ++i)
    if (cloud.labels[i] == SceneClass::Vehicle) group_of[vehicleSquare(cloud.scene.points[i])] = kNew;
  std::size_t groups = 0;
  for (auto& [square, group] : group_of) {
    if (group != kNew) continue;
    std::vector<std::pair<int, int>> open = {square};
    for (group = groups++; !open.empty();) {
      const std::pair<int, int> middle = open.back();
      open.pop_back();
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const auto neighbour = group_of.find({middle.first + j, middle.second + k});
          if (neighbour == group_of.end() || neighbour->second != kNew) continue;
          neighbour->second = group;
          open.push_back(neighbour->first);
        }
    }
  }
  return group_of;
}

/// Makes vans, lorries and buses of some of the simulator's cars: they grow upwards, and away from the sensor, which is
/// at the origin.
void enlargeVehicles(LabelledCloud& cloud, Draws& draws) {
  struct Vehicle {
    Eigen::Vector3f nearest = Eigen::Vector3f::Constant(1e6F);
    float low = 1e6F, high = -1e6F, up = 1.0F, along = 1.0F;
  };
  const std::map<std::pair<int, int>, std::size_t> group_of = groupVehicles(cloud);
  std::vector<Vehicle> vehicles(group_of.size());
  const auto forEachPoint = [&](const auto& take) {
    for (std::size_t i = 0; i < cloud.labels.size(); ++i)
      if (cloud.labels[i] == SceneClass::Vehicle)
        take(cloud.scene.points[i], vehicles[group_of.at(vehicleSquare(cloud.scene.points[i]))]);
  };
  forEachPoint([](const Eigen::Vector3f& p, Vehicle& vehicle) {
    if (p.head<2>().norm() < vehicle.nearest.head<2>().norm()) vehicle.nearest = p;
    vehicle.low = std::min(vehicle.low, p.z());
    vehicle.high = std::max(vehicle.high, p.z());
  });
  for (Vehicle& vehicle : vehicles) {
    const float height = vehicle.high - vehicle.low, wanted = draws.uniform(kVanHeight, kLargestHeight);
    const float along = draws.uniform(1.0F, kMostLengthening);
    if (draws.uniform(0.0F, 1.0F) > kShareOfLarge || height < kLeastCar || height > wanted) continue;
    vehicle.up = wanted / height;
    vehicle.along = along;
  }
  std::vector<Eigen::Vector3f> moved;
  forEachPoint([&](const Eigen::Vector3f& p, Vehicle& vehicle) {
    const Eigen::Vector2f plan = vehicle.nearest.head<2>() + vehicle.along * (p - vehicle.nearest).head<2>();
    moved.emplace_back(plan.x(), plan.y(), vehicle.low + vehicle.up * (p.z() - vehicle.low));
  });
  auto next = moved.begin();
  for (std::size_t i = 0; i < cloud.labels.size(); ++i)
    if (cloud.labels[i] == SceneClass::Vehicle) cloud.scene.points[i] = *next++;
}

/// Cloud of the sweeps from `begin` to before `end`, turned about the vertical, with errors of poses.
LabelledCloud makeCloud(const DriveReturns& returns, const std::vector<SceneClass>& labels, std::size_t begin,
                        std::size_t end, Draws& draws) {
  const float angle = draws.uniform(0.0F, 2.0F * static_cast<float>(M_PI));
  const float jitter = end - begin > 1 ? std::max(0.0F, draws.uniform(-kMostJitter, kMostJitter)) : 0.0F;
  const float cosine = std::cos(angle), sine = std::sin(angle);
  Eigen::Matrix3f R = Eigen::Matrix3f::Identity();
  R.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
  const auto first = std::lower_bound(returns.sweeps.begin(), returns.sweeps.end(), begin) - returns.sweeps.begin();
  LabelledCloud cloud;
  PointLimit limit;
  Ground ground(draws);
  for (auto i = static_cast<std::size_t>(first); i < returns.points.size() && returns.sweeps[i] < end; ++i) {
    if (end - begin > 1 && !limit.admits(returns.points[i])) continue;
    const Eigen::Vector3f error(draws.normal(), draws.normal(), draws.normal());
    const SceneClass kind = ground.changeKind(labels[i]);
    const Eigen::Vector3f point = ground.place(returns.points[i], returns.origins[returns.sweeps[i]], kind);
    cloud.scene.points.push_back(R * (point - returns.origins[begin]) + jitter * error);
    cloud.labels.push_back(kind);
  }
  enlargeVehicles(cloud, draws);
  return cloud;
}

}  // namespace

std::vector<LabelledCloud> makeClouds(const CloudDrive& drive, const DriveReturns& returns) {
  std::uint64_t seed = drive.seed;
  for (const char letter : drive.name()) seed = 31 * seed + static_cast<unsigned char>(letter);
  Draws draws(seed);
  const Facades facades(returns);
  std::vector<SceneClass> labels;
  for (std::size_t i = 0; i < returns.points.size(); ++i) {
    const SceneClass label = withOneWall(static_cast<SceneClass>(returns.classes[i]));
    labels.push_back(label == SceneClass::Other && facades.hold(returns.points[i]) ? SceneClass::None : label);
  }
  const std::size_t sweeps = returns.sweepCount();
  std::vector<LabelledCloud> clouds;
  if (drive.device != "lasers") {
    for (const std::size_t at : {std::size_t{1}, sweeps / 2, sweeps - 2})
      clouds.push_back(makeCloud(returns, labels, at, at + 1, draws));
    for (const std::size_t at : {std::size_t{0}, sweeps / 2})
      clouds.push_back(makeCloud(returns, labels, at, std::min(at + kSecond, sweeps), draws));
  }
  clouds.push_back(makeCloud(returns, labels, 0, sweeps, draws));
  return clouds;
}

}  // namespace urban_nav::bench
