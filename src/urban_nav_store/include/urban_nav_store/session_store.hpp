// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_store/session.hpp"

namespace urban_nav_store {

/// A parameter of a stage as it was in force, and where it came from.
struct StoredParameter {
  std::string name;  ///< "swf_vo.window"
  std::string value;
  std::string origin;
};

/// Anything else that is known of a session, by name: "version", "input/0/path". Sorted by name.
struct Property {
  std::string name, value;
};

/// Where a sensor's frame stands on the robot.
struct Extrinsic {
  std::string frame;
  urban_nav_core::Pose T_base_frame;
};

/// Sessions and where they came from. What stands under a name is replaced by what is put there later.
class SessionStore {
 public:
  virtual ~SessionStore() = default;

  /// A session that is there already keeps its rows; only `complete` and the words for people are replaced. UserError where
  /// robot, recording or start contradict the ones that are there.
  virtual void put(const Session& session) = 0;
  virtual std::optional<Session> find(const SessionId& id) const = 0;
  /// In order of start, then id.
  virtual std::vector<Session> all() const = 0;
  /// Removes a session with every row that names it, edges from other sessions to it included.
  virtual void remove(const SessionId& id) = 0;
  /// Likewise, but what was measured in it stays: its scans and keyframes.
  virtual void clear(const SessionId& id) = 0;

  virtual void put(const Anchor& anchor) = 0;
  virtual std::optional<Anchor> anchor(const SessionId& id) const = 0;

  virtual void put(const SessionId& id, const StoredParameter& parameter) = 0;
  virtual std::vector<StoredParameter> parameters(const SessionId& id) const = 0;
  virtual void put(const SessionId& id, const Property& property) = 0;
  virtual std::vector<Property> properties(const SessionId& id) const = 0;
  virtual void put(const SessionId& id, const Extrinsic& extrinsic) = 0;
  virtual std::vector<Extrinsic> extrinsics(const SessionId& id) const = 0;
};

}  // namespace urban_nav_store
