// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "fabmap_node/decision/place_verdict.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Verdicts of geometry on the earlier places that observations show, from the closures of a store. Of several
/// verdicts the one most in favour counts: confirmed, accepted, withdrawn, rejected.
class StoredVerdicts {
 public:
  explicit StoredVerdicts(urban_nav_store::Store& store);

  /// Returns "confirmed", "accepted", "withdrawn" or "rejected" for the observation of a session that is nearest to the
  /// later pose of a closure, within 0.5 s; empty without a verdict.
  const std::string& find(const urban_nav_store::SessionId& session, urban_nav_core::StampNs stamp) const;

 private:
  using Observation = std::pair<urban_nav_store::SessionId, urban_nav_core::StampNs>;
  std::map<Observation, std::string> words_;
};

}  // namespace urban_nav
