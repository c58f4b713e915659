// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/agreement_cache.hpp"

#include <tuple>

namespace fabmap_node {

namespace {

constexpr std::size_t kMixing = 0x9e3779b97f4a7c15;  // 2^64 by the golden ratio (Knuth, section 6.4)

std::size_t mixed(std::size_t hash, std::size_t value) { return (hash ^ value) * kMixing + (hash >> 29); }

}  // namespace

bool AgreementCache::Key::operator==(const Key& other) const {
  return std::tie(a, b, session_a, session_b, step) ==
         std::tie(other.a, other.b, other.session_a, other.session_b, other.step);
}

std::size_t AgreementCache::KeyHash::operator()(const Key& key) const {
  std::size_t hash = key.step;
  for (const std::size_t part :
       {static_cast<std::size_t>(key.a), static_cast<std::size_t>(key.b), key.session_a, key.session_b})
    hash = mixed(hash, part);
  return hash ^ (hash >> 32);
}

AgreementCache::Key AgreementCache::toKey(const Observation& a, const Observation& b, std::size_t step) const {
  return {a.stamp, b.stamp, sessions_.at(a.session), sessions_.at(b.session), step};
}

std::optional<AgreementCache::Agreement> AgreementCache::find(const Observation& a, const Observation& b,
                                                              std::size_t step) const {
  const auto known = agreements_.find(toKey(a, b, step));
  return known == agreements_.end() ? std::nullopt : std::optional<Agreement>(known->second);
}

void AgreementCache::keep(const Observation& a, const Observation& b, std::size_t step, const Agreement& agreement) {
  if (agreements_.size() < kMostPairs) agreements_.emplace(toKey(a, b, step), agreement);
}

}  // namespace fabmap_node
