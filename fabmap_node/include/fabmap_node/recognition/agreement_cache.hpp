// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "fabmap_node/recognition/second_look.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace fabmap_node {

/// Agreements of descriptors that several maps of the same observations have in common, so that each pair is compared
/// once. Keeps up to 2 million pairs (about 160 MB); further ones are compared each time, with the same result. Not
/// thread-safe.
class AgreementCache {
 public:
  using Agreement = LookAgreement;
  static constexpr std::size_t kMostPairs = 2'000'000;

  /// Observation of a map, by the index of its session in that map.
  struct Observation {
    std::size_t session = 0;
    urban_nav_core::StampNs stamp = 0;
  };

  /// Starts the next map. `sessions`: numbers of its sessions that are the same in all maps, by their indices.
  void beginMap(std::vector<std::size_t> sessions) { sessions_ = std::move(sessions); }

  /// Returns secondLook() of `a` with every `step`-th descriptor of `b`; nullopt if it is not kept.
  std::optional<Agreement> find(const Observation& a, const Observation& b, std::size_t step) const;
  void keep(const Observation& a, const Observation& b, std::size_t step, const Agreement& agreement);
  std::size_t pairs() const { return agreements_.size(); }

 private:
  struct Key {
    urban_nav_core::StampNs a = 0, b = 0;
    std::size_t session_a = 0, session_b = 0, step = 1;
    bool operator==(const Key& other) const;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };
  Key toKey(const Observation& a, const Observation& b, std::size_t step) const;

  std::vector<std::size_t> sessions_;
  std::unordered_map<Key, Agreement, KeyHash> agreements_;
};

}  // namespace fabmap_node
