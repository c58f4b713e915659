// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/session_pass.hpp"
#include "map/stage.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/trajectory/travel_spacing.hpp"

namespace urban_nav {

/// Pass that stores data of sensors as selected by the motion of the robot (TravelSpacing).
class SpacedPass : public SessionPass {
 public:
  /// `name`: of its checkpoints. Continues after the checkpoint of `start`, if there is one.
  SpacedPass(std::string name, urban_nav_core::TravelSpacing::Spacing spacing, MapContext& context,
             const Stage::SessionStart& start);
  void process(PassItem&) override {}
  std::string checkpoint() override;

 protected:
  urban_nav_store::Store& store() { return store_; }
  MapSession& session() { return session_; }
  /// Returns whether data of a role were stored before.
  bool hasStored(const std::string& role) const;
  /// Returns whether data of a role are stored.
  bool takes(const std::string& role, urban_nav_core::StampNs stamp);

 private:
  struct Role {
    std::string name;
    urban_nav_core::TravelSpacing spacing;
    void archive(urban_nav_core::Archive& archive) { archive(name, spacing); }
  };
  /// State of the pass at the end of a bag.
  struct State {
    std::vector<Role> roles;
    void archive(urban_nav_core::Archive& archive) { archive(roles); }
  };

  const std::string name_;
  const urban_nav_core::TravelSpacing::Spacing spacing_;
  urban_nav_store::Store& store_;
  MapSession& session_;
  State state_;
};

}  // namespace urban_nav
