// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fabmap_node/decision/closure_selector.hpp"
#include "fabmap_node/decision/place_belief.hpp"
#include "fabmap_node/parameters.hpp"
#include "fabmap_node/recognition/place_recogniser.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace fabmap_node {

/// Belief after an observation, and the closures to be measured.
struct PlaceOutput {
  PlaceBelief belief;
  /// a: the earlier place, b: the observation. At most one of each session in the belief, so that a place revisited
  /// within a day is also connected to other days.
  std::vector<urban_nav_core::TopologicalClosure> closures;
};

/// Recognises places in the observations of consecutive sessions (Newman et al. 2009, section 3) and proposes closures.
/// Places of earlier sessions must be added first. Identical calls give bit-identical results for any number of
/// threads. Not thread-safe.
class FabMap {
 public:
  /// The model must outlive the object. With `read_look` the map does not keep the words and descriptors of places
  /// beside its index; descriptors are read by the thread that calls process(). Sessions are numbered from 0.
  FabMap(const PlaceModel& model, const Parameters& parameters, LookReader read_look = {});

  /// Starts a session to which subsequent observations belong.
  void beginSession(const std::string& name);
  /// Renames the last session, for subsequent closures.
  void renameSession(const std::string& name) { sessions_.back() = name; }
  /// Adds an observation as a place of the map without recognition.
  void addPlace(urban_nav_core::StampNs stamp, const PlaceDescription& description, double travelled);
  /// Recognises an observation, then adds it to the map unless the robot is stationary. Stamps within a session must
  /// ascend. `travelled`: m since the beginning of the session.
  PlaceOutput process(urban_nav_core::StampNs stamp, const PlaceDescription& description, double travelled);

  std::size_t places() const { return recogniser_.places(); }
  /// Returns a place of the map; requires i < places(). Its session is an index of sessions().
  const DescribedPlace& place(std::size_t i) const { return recogniser_.place(i); }
  /// Returns the distance travelled in its session up to a place, m.
  double travelled(std::size_t i) const { return travelled_[i]; }
  /// Returns the distance travelled in its session up to a pose, m, interpolated between places; nullopt unless the
  /// pose is between places of one of the sessions, or at one.
  std::optional<double> travelled(const urban_nav_core::PoseRef& at) const;
  /// Returns the names of the sessions.
  const std::vector<std::string>& sessions() const { return sessions_; }

 private:
  PlaceBelief toBelief(const PlaceRecognition& recognition) const;

  const Parameters parameters_;
  PlaceRecogniser recogniser_;
  ClosureSelector selector_;
  std::vector<std::string> sessions_;
  std::vector<double> travelled_;              // per place
  std::optional<ComparedFeatures> last_look_;  // in this session
  PlaceBelief last_belief_;
};

}  // namespace fabmap_node
