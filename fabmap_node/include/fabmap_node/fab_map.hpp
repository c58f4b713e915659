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

/// Closure that geometry accepted: both poses are at one place.
struct ConfirmedClosure {
  urban_nav_core::PoseRef a, b;                 ///< sessions as named in the map
  double travelled_a = 0.0, travelled_b = 0.0;  ///< to both poses in their sessions, m
  double metres = 0.0;                          ///< between the poses
  bool is_same_direction = true;                ///< of both drives
};

/// Recognises places in the observations of consecutive sessions (Newman et al. 2009, section 3) and proposes closures.
/// Places of earlier sessions must be added first. Identical calls give bit-identical results for any number of
/// threads. Not thread-safe.
class FabMap {
 public:
  /// The model must outlive the object. With `read_look` the map does not keep the words and descriptors of places
  /// beside its index; descriptors are read by the thread that calls process(). Sessions are numbered from 0.
  /// `known_agreements`: see MatcherOptions.
  FabMap(const PlaceModel& model, const Parameters& parameters, LookReader read_look = {},
         AgreementCache* known_agreements = nullptr);

  /// Starts a session to which subsequent observations belong.
  void beginSession(const std::string& name);
  /// Renames the last session, for subsequent closures.
  void renameSession(const std::string& name) { sessions_.back() = name; }
  /// Adds an observation as a place of the map without recognition.
  void addPlace(urban_nav_core::StampNs stamp, const PlaceDescription& description, double travelled);
  /// Recognises an observation, then adds it to the map unless the robot is stationary. Stamps within a session must
  /// ascend. `travelled`: m since the beginning of the session.
  PlaceOutput process(urban_nav_core::StampNs stamp, const PlaceDescription& description, double travelled);

  /// Lets the places at `a` take in the observations at `b` as appearances (PlaceGroups), those of the 2 m before and
  /// after each pose included, now or when they are processed. Both sessions must be in the map, else nothing happens;
  /// another closure between the same poses replaces it.
  void confirm(const ConfirmedClosure& closure);
  /// Removes a closure and its appearances.
  void withdraw(const urban_nav_core::PoseRef& a, const urban_nav_core::PoseRef& b);
  /// Returns the number of places that are no longer compared, since their place has eight other appearances.
  std::size_t forgotten() const;
  /// Returns whether a place is one of these; requires i < places().
  bool isForgotten(std::size_t i) const { return recogniser_.groups().isForgotten(i); }

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
  /// Confirmed closure between two sessions of the map, and the pairs that follow from it.
  struct Learnt {
    ConfirmedClosure closure;
    std::size_t session_a = 0, session_b = 0;
    std::vector<ConfirmedPair> pairs;
  };
  PlaceBelief toBelief(const PlaceRecognition& recognition) const;
  std::optional<std::size_t> findSession(const std::string& name) const;
  void learn(Learnt& learnt, std::size_t observation);

  const Parameters parameters_;
  PlaceRecogniser recogniser_;
  ClosureSelector selector_;
  std::vector<std::string> sessions_;
  std::vector<double> travelled_;              // per place
  std::vector<Learnt> learnt_;                 // in order of confirmation
  std::optional<ComparedFeatures> last_look_;  // in this session
  PlaceBelief last_belief_;
};

}  // namespace fabmap_node
