// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/distance_field.hpp"

#include <algorithm>
#include <cmath>

namespace laser_mapper {

using Eigen::Vector3d;
using Eigen::Vector3f;
using urban_nav_registration::CellTable;

namespace {

constexpr int kPointReach = 2;        // edges around a point whose nodes it affects
constexpr float kLeastWeight = 0.2F;  // weight of a point on the node is 1

Vector3d positionOf(const DistanceField::Node& node, double edge) { return edge * Vector3d(node.x, node.y, node.z); }

}  // namespace

void DistanceField::add(const MapPoint& point) {
  if (point.normal.squaredNorm() < 0.5F) return;
  const Vector3d scaled = point.p.cast<double>() / edge_;
  const Vector3d normal = point.normal.cast<double>();
  const Node middle{static_cast<int>(std::lround(scaled.x())), static_cast<int>(std::lround(scaled.y())),
                    static_cast<int>(std::lround(scaled.z()))};
  const Vector3f colour(point.red, point.green, point.blue);
  for (int dz = -kPointReach; dz <= kPointReach; ++dz)
    for (int dy = -kPointReach; dy <= kPointReach; ++dy)
      for (int dx = -kPointReach; dx <= kPointReach; ++dx) {
        const Node node{middle.x + dx, middle.y + dy, middle.z + dz};
        const Vector3d d = Vector3d(node.x, node.y, node.z) - scaled;
        const double square = d.squaredNorm() / (kPointReach * kPointReach);
        if (square >= 1.0) continue;
        const auto weight = static_cast<float>((1.0 - square) * (1.0 - square));
        const std::uint32_t number = table_.insert(toKey(node));
        if (number == nodes_.size()) {
          nodes_.emplace_back();
          nodes_.back().node = node;
        }
        Sums& sums = nodes_[number];
        sums.weight += weight;
        sums.distance += weight * static_cast<float>(edge_ * normal.dot(d));
        sums.colour += weight * colour;
      }
}

std::optional<DistanceField::Value> DistanceField::valueOf(const Sums& sums) {
  if (sums.weight < kLeastWeight) return std::nullopt;
  return Value{sums.node, sums.distance / sums.weight, sums.colour / sums.weight};
}

std::vector<DistanceField::Value> DistanceField::values() const {
  std::vector<Value> known;
  for (const Sums& sums : nodes_)
    if (const auto value = valueOf(sums)) known.push_back(*value);
  return known;
}

std::optional<DistanceField::Value> DistanceField::at(const Node& node) const {
  const std::uint32_t number = table_.find(toKey(node));
  return number == CellTable::kNone ? std::nullopt : valueOf(nodes_[number]);
}

std::optional<TriangleMesh::Vertex> DistanceField::vertexAt(const Node& node) const {
  std::array<Value, 8> corners;
  Vector3f colour = Vector3f::Zero();
  for (int i = 0; i < 8; ++i) {
    const auto value = at({node.x + (i & 1), node.y + ((i >> 1) & 1), node.z + (i >> 2)});
    if (!value) return std::nullopt;
    corners[static_cast<std::size_t>(i)] = *value;
    colour += value->colour / 8.0F;
  }
  Vector3d sum = Vector3d::Zero();
  int crossings = 0;
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4}) {
      if ((i & bit) != 0) continue;
      const Value &a = corners[static_cast<std::size_t>(i)], &b = corners[static_cast<std::size_t>(i | bit)];
      if ((a.distance < 0.0F) == (b.distance < 0.0F)) continue;
      const double share = static_cast<double>(a.distance) / static_cast<double>(a.distance - b.distance);
      sum += (1.0 - share) * positionOf(a.node, edge_) + share * positionOf(b.node, edge_);
      ++crossings;
    }
  if (crossings == 0) return std::nullopt;
  TriangleMesh::Vertex vertex;
  vertex.p = (sum / crossings).cast<float>();
  const auto byte = [](float value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F))); };
  vertex.red = byte(colour.x());
  vertex.green = byte(colour.y());
  vertex.blue = byte(colour.z());
  return vertex;
}

}  // namespace laser_mapper
