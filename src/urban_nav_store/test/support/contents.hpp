// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <string>

#include "urban_nav_store/store.hpp"

namespace urban_nav_store::testing {

/// Random content from a seed, with all digits of doubles in use.
class Drawn {
 public:
  explicit Drawn(std::uint32_t seed) : random_(seed) {}

  Session session();
  Node node(urban_nav_core::StampNs stamp);
  RelaxedPose relaxed(urban_nav_core::StampNs stamp);
  Edge edge(const NodeRef& a, const NodeRef& b, EdgeKind kind);
  urban_nav_core::Scan scan(urban_nav_core::StampNs stamp, int beams);
  std::string bytes(std::size_t size);
  urban_nav_core::Pose pose();
  urban_nav_core::Matrix6d matrix();

 private:
  std::mt19937 random_;
};

/// Writes a session with rows in all tables, without a commit. Returns its id.
SessionId fill(Store& store, std::uint32_t seed, int nodes);

}  // namespace urban_nav_store::testing
