// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/closure_import.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <tuple>

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using pose_graph::Closure;
using pose_graph::EdgeKind;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

namespace {

// Of a transform whose file has no sigma: five times what loop closure by stereo reaches (paper, section 4.1).
constexpr double kUnknownSigmaM = 0.25, kUnknownSigmaRad = 0.05;

/// Identity of a closure in the graph, and its numbers; sessions by their index.
using Place = std::tuple<std::size_t, StampNs, std::size_t, StampNs, EdgeKind>;
using Numbers = std::array<double, 8>;

Numbers toNumbers(const Closure& closure) {
  const Pose& T = closure.measured.T_a_b;
  return {T.t().x(), T.t().y(), T.t().z(), T.q().x(),
          T.q().y(), T.q().z(), T.q().w(), closure.measured.information.trace()};
}

class ClosureImport {
 public:
  ClosureImport(const std::vector<std::string>& sessions, const std::vector<const SessionOdometry*>& runs)
      : sessions_(sessions) {
    for (const SessionOdometry* one : runs) odometry_.push_back(odometryChain(*one));
  }

  /// Adds a row of the file. `row`: its index in GraphRun::closures. Returns why it cannot be used; empty if it can.
  std::string add(std::size_t row, const ClosureRow& offered) {
    for (const std::string* name : {&offered.session_a, &offered.session_b})
      if (findPlace(*name) == sessions_.size())
        return "no session \"" + *name + "\" in this map; there are: " + listing();
    if (offered.measured && offered.measured->verdict != urban_nav_core::ClosureVerdict::Accepted)
      return offered.measured->reason_name + ": " + offered.measured->sentence;
    if (!offered.T_a_b) return "no transform in the file, and no stage that finds one";
    Closure closure;
    Matrix6d from_offered = Matrix6d::Identity();  // d_offered = from_offered d, of perturbations of T_a_b
    Pose T_a_b = *offered.T_a_b;
    for (const bool at_a : {true, false}) {
      const std::string& name = at_a ? offered.session_a : offered.session_b;
      const StampNs stamp = at_a ? offered.stamp_a : offered.stamp_b;
      const std::size_t session = findPlace(name);
      const auto moment = odometry_[session].nearestFrame(stamp);
      if (!moment) return "no frames around " + urban_nav_core::printStamp(stamp) + " s in " + name;
      (at_a ? closure.a : closure.b) = {name, moment->frame};
      const Pose& T_frame_pose = moment->T_frame_pose;
      const Pose T_pose_frame = T_frame_pose.inverse();
      from_offered *= at_a ? compose(T_pose_frame, T_frame_pose * T_a_b).J2
                           : Matrix6d(2.0 * Matrix6d::Identity() - compose(T_a_b, T_pose_frame).J1);
      T_a_b = at_a ? T_frame_pose * T_a_b : T_a_b * T_pose_frame;
    }
    closure.kind = offered.kind == "icp" ? EdgeKind::Icp : EdgeKind::Stereo;
    closure.source = offered.where;
    closure.measured.T_a_b = T_a_b;
    if (offered.measured) {
      closure.odometry_gate = offered.measured->odometry_gate;
      closure.measured.information =
          urban_nav_core::transformInformation(from_offered, offered.measured->measured.information);
    } else {
      const double sigma_m = offered.sigma_m > 0.0 ? offered.sigma_m : kUnknownSigmaM;
      const double sigma_rad = offered.sigma_rad > 0.0 ? offered.sigma_rad : kUnknownSigmaRad;
      closure.measured.information.diagonal().head<3>().setConstant(1.0 / (sigma_m * sigma_m));
      closure.measured.information.diagonal().tail<3>().setConstant(1.0 / (sigma_rad * sigma_rad));
    }
    offers_.push_back({toKey(closure), row, closure});
    return {};
  }

  /// Adds previous closures but those that a row of the file replaces. Asserted ones are of another kind and stay.
  void add(const std::vector<PreviousClosure>& previous) {
    std::set<Place> in_file;
    for (const Offer& offer : offers_) in_file.insert(offer.key.first);
    for (std::size_t row = 0; row < previous.size(); ++row) {
      const Key key = toKey(previous[row].closure);
      if (in_file.count(key.first) == 0) offers_.push_back({key, row, previous[row].closure});
    }
  }

  ClosureIds addTo(GraphRun& run) {
    std::stable_sort(offers_.begin(), offers_.end(), [](const Offer& a, const Offer& b) { return a.key < b.key; });
    ClosureIds ids;
    for (const Offer& offer : offers_) {
      try {
        ids[offer.row] = run.graph.addClosure(offer.closure);
      } catch (const urban_nav_core::UserError& error) {
        run.closures[offer.row].reason = error.what();
      }
    }
    return ids;
  }

 private:
  using Key = std::pair<Place, Numbers>;
  struct Offer {
    Key key;
    std::size_t row;
    Closure closure;
  };

  std::size_t findPlace(const std::string& session) const {
    return static_cast<std::size_t>(std::find(sessions_.begin(), sessions_.end(), session) - sessions_.begin());
  }
  Key toKey(const Closure& closure) const {
    return {
        {findPlace(closure.a.session), closure.a.stamp, findPlace(closure.b.session), closure.b.stamp, closure.kind},
        toNumbers(closure)};
  }
  std::string listing() const {
    std::string text;
    for (const std::string& name : sessions_) text += (text.empty() ? "" : ", ") + name;
    return text;
  }

  const std::vector<std::string>& sessions_;
  std::vector<urban_nav_core::OdometryChain> odometry_;
  std::vector<Offer> offers_;
};

}  // namespace

ClosureIds importClosures(GraphRun& run, const std::vector<const SessionOdometry*>& runs,
                          const std::vector<ClosureRow>& rows, const std::vector<PreviousClosure>& previous) {
  ClosureImport import(run.sessions, runs);
  for (const PreviousClosure& each : previous) {
    run.closures.push_back(each.row);
    run.closures.back().reason.clear();
  }
  for (const ClosureRow& row : rows) {
    const std::string reason = import.add(run.closures.size(), row);
    run.closures.push_back(row);
    run.closures.back().reason = reason;
  }
  import.add(previous);
  return import.addTo(run);
}

}  // namespace urban_nav
