// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_store/session.hpp"

namespace urban_nav_store {

/// Effective value of a stage's parameter, and its origin.
struct StoredParameter {
  std::string name;  ///< "swf_vo.window"
  std::string value;
  std::string origin;
};

/// Other named property of a session: "version", "input/0/path". Sorted by name.
struct Property {
  std::string name, value;
};

/// Pose of a sensor's frame on the robot.
struct Extrinsic {
  std::string frame;
  urban_nav_core::Pose T_base_frame;
};

/// Sessions with their parameters, properties and sensors. An entry with the same name is replaced.
class SessionStore {
 public:
  virtual ~SessionStore() = default;

  /// Adds a session. If it exists, only `complete` and `name` are replaced and its rows are kept. Throws UserError if
  /// robot, recording or start differ from the stored ones.
  virtual void put(const Session& session) = 0;
  virtual std::optional<Session> find(const SessionId& id) const = 0;
  /// Returns all sessions in order of start, then id.
  virtual std::vector<Session> all() const = 0;
  /// Removes a session with every row that refers to it, including edges from other sessions to it.
  virtual void remove(const SessionId& id) = 0;
  /// Removes a session except for its measurements: scans, keyframes and other tables declared kept_by_clear.
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
