// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/instances/instance_finder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace scene_labeler {
namespace {

constexpr double kCellEdge = 0.1;      // m, of the cells that are connected
constexpr double kGroundSquare = 0.2;  // m
constexpr double kVehicleLink = 0.3;   // m: larger gaps separate parts; bumpers of parked cars are further apart
constexpr double kSlenderLink = 0.2;   // m
constexpr double kGroundSearch = 3.0;  // m

// Largest car without a trailer, in the European Union: 2.55 m wide (directive 96/53/EC); vans are up to 6 m long.
constexpr double kLongestCar = 6.2, kWidestCar = 2.6;                   // m
constexpr double kLeastVehicleLength = 0.8, kLeastVehicleHeight = 0.4;  // m: less is a wrong label
constexpr std::size_t kFewestVehiclePoints = 30, kFewestSlenderPoints = 8;
constexpr double kFreeShare = 0.2;                                              // share of squares between two parts
constexpr double kAboveGround = 0.2;                                            // m: lower points are kerbs and grass
constexpr double kHighestBase = 0.7;                                            // m: higher things hang
constexpr double kTrunkTop = 2.0;                                               // m: the diameter is measured below
constexpr double kLeastPerson = 1.0, kMostPerson = 2.1;                         // m, children and tall adults
constexpr double kThinnestPerson = 0.25, kWidestPerson = 1.2;                   // m, with arms and in stride
constexpr double kLeastPole = 1.2, kLeastThickPole = 2.2, kThickestPole = 0.6;  // m

bool isInGrid(int x, int y) { return std::max(std::abs(x), std::abs(y)) <= urban_nav_registration::kFarthestCell; }

struct DisjointSets {
  std::vector<std::size_t> parent;
  explicit DisjointSets(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0); }
  std::size_t root(std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  /// The lower number becomes the root.
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
};

}  // namespace

const char* toString(InstanceKind kind) {
  switch (kind) {
    case InstanceKind::Vehicle: return "vehicle";
    case InstanceKind::Person: return "person";
    case InstanceKind::Pole: return "pole";
  }
  return "";
}

InstanceFinder::Square InstanceFinder::toSquare(double x, double y, double edge) {
  return {static_cast<int>(std::floor(x / edge)), static_cast<int>(std::floor(y / edge))};
}

void InstanceFinder::add(const Eigen::Vector3f& point, const PointLabel& label, urban_nav_core::StampNs stamp) {
  if (!point.allFinite()) return;
  if (isKindOfGround(label.label)) {
    const Square square = toSquare(point.x(), point.y(), kGroundSquare);
    if (!isInGrid(square.first, square.second)) return;
    const std::uint32_t number =
        ground_squares_.insert(urban_nav_registration::toKey({square.first, square.second, 0}));
    if (number == ground_.size()) ground_.emplace_back();
    ground_[number].sum += point.z();
    ++ground_[number].count;
  }
  if (label.label == SceneClass::Vehicle) vehicles_.push_back({point, label.probability, stamp});
  if (label.label == SceneClass::Other) others_.push_back({point, label.probability, stamp});
}

const InstanceFinder::Ground* InstanceFinder::findGround(const Square& square) const {
  if (!isInGrid(square.first, square.second)) return nullptr;
  const std::uint32_t number = ground_squares_.find(urban_nav_registration::toKey({square.first, square.second, 0}));
  return number == urban_nav_registration::CellTable::kNone ? nullptr : &ground_[number];
}

double InstanceFinder::groundAt(const Eigen::Vector2d& place, double otherwise) const {
  const Square middle = toSquare(place.x(), place.y(), kGroundSquare);
  const int farthest = static_cast<int>(kGroundSearch / kGroundSquare);
  for (int reach = 0; reach <= farthest; ++reach) {  // squares around the place, from the inside outwards
    double sum = 0.0, count = 0.0;
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; i += std::abs(j) == reach ? 1 : std::max(1, 2 * reach))
        if (const Ground* ground = findGround({middle.first + i, middle.second + j})) {
          sum += static_cast<double>(ground->sum);
          count += ground->count;
        }
    if (count > 0.0) return sum / count;
  }
  return otherwise;
}

std::vector<InstanceFinder::Cluster> InstanceFinder::connect(const std::vector<Candidate>& candidates,
                                                             double link) const {
  std::map<Square, std::size_t> cell_at;
  std::vector<Square> cells;
  std::vector<std::size_t> cell_of;
  for (const Candidate& candidate : candidates) {
    const Square square = toSquare(candidate.p.x(), candidate.p.y(), kCellEdge);
    const auto [found, is_new] = cell_at.try_emplace(square, cells.size());
    if (is_new) cells.push_back(square);
    cell_of.push_back(found->second);
  }
  DisjointSets sets(cells.size());
  const int reach = static_cast<int>(std::lround(link / kCellEdge));
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    for (int j = 0; j <= reach; ++j)
      for (int i = j == 0 ? 1 : -reach; i <= reach; ++i) {
        if (i * i + j * j > reach * reach) continue;
        const auto other = cell_at.find({cells[cell].first + i, cells[cell].second + j});
        if (other != cell_at.end()) sets.join(cell, other->second);
      }
  std::map<std::size_t, Cluster> clusters;
  for (std::size_t i = 0; i < candidates.size(); ++i) clusters[sets.root(cell_of[i])].push_back(i);
  std::vector<Cluster> parts;
  for (auto& entry : clusters) parts.push_back(std::move(entry.second));
  return parts;
}

OrientedBox InstanceFinder::fitCluster(const std::vector<Candidate>& candidates, const Cluster& cluster) {
  std::vector<Eigen::Vector2d> points;
  for (const std::size_t i : cluster) points.emplace_back(candidates[i].p.head<2>().cast<double>());
  return fitBox(points);
}

Instance InstanceFinder::describe(InstanceKind kind, const std::vector<Candidate>& candidates,
                                  const Cluster& cluster) const {
  Instance instance;
  instance.kind = kind;
  instance.box = fitCluster(candidates, cluster);
  instance.points = cluster.size();
  instance.first = instance.last = candidates[cluster.front()].stamp;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::size_t i : cluster) {
    const Candidate& candidate = candidates[i];
    low = std::min(low, static_cast<double>(candidate.p.z()));
    high = std::max(high, static_cast<double>(candidate.p.z()));
    instance.probability += candidate.probability / 255.0 / static_cast<double>(cluster.size());
    instance.first = std::min(instance.first, candidate.stamp);
    instance.last = std::max(instance.last, candidate.stamp);
  }
  instance.bottom = std::min(groundAt(instance.box.centre, low), high);
  instance.height = high - instance.bottom;
  return instance;
}

bool InstanceFinder::isGroundBetween(const OrientedBox& a, const OrientedBox& b, const OrientedBox& joint) const {
  std::size_t squares = 0, seen = 0;
  const int along = static_cast<int>(0.5 * joint.length / kGroundSquare),
            across = static_cast<int>(0.5 * joint.width / kGroundSquare);
  const Eigen::Vector2d x(std::cos(joint.heading), std::sin(joint.heading)), y(-x.y(), x.x());
  for (int i = -along; i <= along; ++i)
    for (int j = -across; j <= across; ++j) {
      const Eigen::Vector2d place = joint.centre + kGroundSquare * (i * x + j * y);
      if (a.holds(place, 0.5 * kGroundSquare) || b.holds(place, 0.5 * kGroundSquare)) continue;
      ++squares;
      if (findGround(toSquare(place.x(), place.y(), kGroundSquare)) != nullptr) ++seen;
    }
  return static_cast<double>(seen) > kFreeShare * static_cast<double>(squares);
}

bool InstanceFinder::areOneVehicle(const Cluster& a, const Cluster& b) const {
  const Eigen::Vector2d from = vehicles_[a.front()].p.head<2>().cast<double>(),
                        to = vehicles_[b.front()].p.head<2>().cast<double>();
  if ((to - from).norm() > kLongestCar + kWidestCar) return false;
  Cluster both = a;
  both.insert(both.end(), b.begin(), b.end());
  const OrientedBox joint = fitCluster(vehicles_, both);
  if (joint.length > kLongestCar || joint.width > kWidestCar) return false;
  return !isGroundBetween(fitCluster(vehicles_, a), fitCluster(vehicles_, b), joint);
}

void InstanceFinder::findVehicles(std::vector<Instance>& found) const {
  std::vector<Cluster> parts = connect(vehicles_, kVehicleLink);
  // Large parts first: small ones join that to which they belong.
  std::stable_sort(parts.begin(), parts.end(), [](const Cluster& a, const Cluster& b) { return a.size() > b.size(); });
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = i + 1; j < parts.size();) {
      if (parts[i].empty() || parts[j].size() < kFewestSlenderPoints || !areOneVehicle(parts[i], parts[j])) {
        ++j;
        continue;
      }
      parts[i].insert(parts[i].end(), parts[j].begin(), parts[j].end());
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;
    }
  for (const Cluster& part : parts) {
    if (part.size() < kFewestVehiclePoints) continue;
    const Instance vehicle = describe(InstanceKind::Vehicle, vehicles_, part);
    if (vehicle.box.length >= kLeastVehicleLength && vehicle.height >= kLeastVehicleHeight) found.push_back(vehicle);
  }
}

void InstanceFinder::findSlender(std::vector<Instance>& found) const {
  std::vector<Candidate> raised;
  std::map<Square, double> heights;  // ground, by squares of a metre
  for (const Candidate& candidate : others_) {
    const Square square = toSquare(candidate.p.x(), candidate.p.y(), 1.0);
    auto height = heights.find(square);
    if (height == heights.end()) {
      const double ground =
          groundAt({square.first + 0.5, square.second + 0.5}, -std::numeric_limits<double>::infinity());
      height = heights.emplace(square, ground).first;
    }
    if (static_cast<double>(candidate.p.z()) > height->second + kAboveGround) raised.push_back(candidate);
  }
  for (const Cluster& cluster : connect(raised, kSlenderLink)) {
    if (cluster.size() < kFewestSlenderPoints) continue;
    Instance one = describe(InstanceKind::Pole, raised, cluster);
    Cluster trunk;
    double base = std::numeric_limits<double>::infinity();
    for (const std::size_t i : cluster) {
      const double above = static_cast<double>(raised[i].p.z()) - one.bottom;
      base = std::min(base, above);
      if (above < kTrunkTop) trunk.push_back(i);
    }
    if (trunk.empty() || base > kHighestBase) continue;
    const double diameter = fitCluster(raised, trunk).length;
    const bool is_pole = (diameter <= kThinnestPerson && one.height >= kLeastPole) ||
                         (diameter <= kThickestPole && one.height >= kLeastThickPole);
    const bool is_person = !is_pole && diameter > kThinnestPerson && diameter <= kWidestPerson &&
                           one.height >= kLeastPerson && one.height <= kMostPerson;
    if (!is_pole && !is_person) continue;
    if (is_person) one.kind = InstanceKind::Person;
    found.push_back(one);
  }
}

std::vector<Instance> InstanceFinder::find() const {
  std::vector<Instance> found;
  findVehicles(found);
  findSlender(found);
  std::sort(found.begin(), found.end(), [](const Instance& a, const Instance& b) {
    return std::make_tuple(a.kind, a.box.centre.x(), a.box.centre.y()) <
           std::make_tuple(b.kind, b.box.centre.x(), b.box.centre.y());
  });
  return found;
}

}  // namespace scene_labeler
