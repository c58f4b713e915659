// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fabmap_node/decision/closure_selector.hpp"
#include "fabmap_node/parameters.hpp"
#include "fabmap_node/recognition/place_recogniser.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace fabmap_node {

/// Whether an observation shows a place of the map.
enum class PlaceKnowledge { Known, Unsure, New };
/// "KNOWN", "UNSURE", "NEW".
const char* toString(PlaceKnowledge knowledge);

/// Place of the map that an observation may show.
struct LikelyPlace {
  urban_nav_core::PoseRef at;
  double probability = 0.0;
};

/// What is known of the robot's place after an observation.
struct PlaceBelief {
  urban_nav_core::PoseRef at;
  ObservationStatus observation = ObservationStatus::Used;  ///< otherwise nothing below is set
  PlaceKnowledge knowledge = PlaceKnowledge::New;
  double p_new = 1.0;                  ///< probability of a place that is not in the map
  std::vector<LikelyPlace> likeliest;  ///< the most likely first
  std::size_t words = 0;               ///< different words of the observation
  int agreeing = 0;                    ///< descriptors that agree with the likeliest place
  bool is_stationary = false;          ///< the robot has not moved: the belief is that of the observation before
};

/// Belief after an observation, and the closures to be measured.
struct PlaceOutput {
  PlaceBelief belief;
  /// a: the earlier place, b: the observation. If the likeliest place is of the same session, that of another one may
  /// be proposed as well: a place that is passed again on one day connects to the other days, too.
  std::vector<urban_nav_core::TopologicalClosure> closures;
};

/// Recognises places in the observations of one session after another (Newman et al. 2009, section 3), decides, and
/// proposes closures. Places of earlier sessions come first. The same calls give the same bits for any number of
/// threads. Not thread-safe.
class FabMap {
 public:
  /// The model must outlive the object. With `read_look` the map keeps neither words nor look of a place beside its
  /// index; looks are read by the thread that calls process(). Sessions count from 0.
  FabMap(const PlaceModel& model, const Parameters& parameters, LookReader read_look = {});

  /// Starts a session; observations that follow belong to it.
  void beginSession(const std::string& name);
  /// Renames the session that was started last, for the closures that follow.
  void renameSession(const std::string& name) { sessions_.back() = name; }
  /// Adds an observation as a place of the map without recognising it.
  void addPlace(urban_nav_core::StampNs stamp, const PlaceDescription& description, double travelled);
  /// Recognises an observation, then adds it to the map, unless the robot stands still. Stamps of a session ascend.
  /// `travelled`: m driven in the session.
  PlaceOutput process(urban_nav_core::StampNs stamp, const PlaceDescription& description, double travelled);

  std::size_t places() const { return recogniser_.places(); }
  /// Returns a place of the map; requires i < places(). Its session is an index of sessions().
  const DescribedPlace& place(std::size_t i) const { return recogniser_.place(i); }
  /// Returns the distance driven in its session until a place, m.
  double travelled(std::size_t i) const { return travelled_[i]; }
  /// Returns the names of the sessions.
  const std::vector<std::string>& sessions() const { return sessions_; }

 private:
  PlaceBelief decide(const PlaceRecognition& recognition) const;

  const double known_probability_, closure_probability_;
  PlaceRecogniser recogniser_;
  ClosureSelector selector_;
  std::vector<std::string> sessions_;
  std::vector<double> travelled_;          // of each place
  std::optional<LookFeatures> last_look_;  // of this session
  PlaceBelief last_belief_;
};

}  // namespace fabmap_node
