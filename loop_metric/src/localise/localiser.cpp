// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/localiser.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace loop_metric {

using urban_nav_core::Constraint;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::StampNs;
using urban_nav_core::Vector6d;

namespace {

constexpr std::size_t most_sightings = 40;           // that are compared, pair by pair
constexpr int enough = 2;                            // witnesses: one may be false
constexpr double apart = 0.5;                        // m: closer than this, a second look is the first one again
constexpr double sighting_metres_per_radian = 10.0;  // for directions of which a sighting knows nothing
constexpr double known_sigma = 0.33;                 // m: three of them are the metre that KNOWN promises
// Looks that a place which is not the robot's answers: three candidates each, of which 3 of 2100 may be accepted when of 2100 pairs of other places none was (README, with
// 95 %).
constexpr double false_share = 3.0 * 3.0 / 2100.0;
constexpr int looks_for_new = 3;           // in a row without anything like it
constexpr int outvoting_witnesses = 3;     // witnesses in a row that agree against all before them
constexpr std::size_t most_steps = 20000;  // of odometry: 10 to 30 minutes, 1.1 kB each

double positionSigma(const PoseWithCovariance& pose) {
  const auto values = urban_nav_core::symmetricEigenvalues(pose.covariance.topLeftCorner<3, 3>());
  return values ? std::sqrt(std::max(0.0, (*values)[2])) : 1e6;
}

/// Of three possibilities: the best guess is right and what says otherwise is false, the other way round, or all of it is false; equally likely before anything was seen.
double probabilityOf(int witnesses, int against) {
  const double odds_best = std::pow((1.0 - false_share) / false_share, witnesses);
  const double odds_other = std::pow((1.0 - false_share) / false_share, against);
  return odds_best / (odds_best + odds_other + 1.0);
}

std::string metres(double value) {
  const int centimetres = static_cast<int>(std::lround(std::min(value, 1e4) * 100.0));
  return std::to_string(centimetres / 100) + "." + std::to_string(centimetres / 10 % 10) +
         std::to_string(centimetres % 10) + " m";
}

}  // namespace

const char* toString(Knowledge knowledge) {
  switch (knowledge) {
    case Knowledge::Unsure: return "UNSURE";
    case Knowledge::Known: return "KNOWN";
    case Knowledge::New: break;
  }
  return "NEW";
}

const char* toString(LocatedReason reason) {
  switch (reason) {
    case LocatedReason::None: return "None";
    case LocatedReason::NothingSeen: return "NothingSeen";
    case LocatedReason::NothingAlike: return "NothingAlike";
    case LocatedReason::BeliefAlone: return "BeliefAlone";
    case LocatedReason::OneSighting: return "OneSighting";
    case LocatedReason::Contested: return "Contested";
    case LocatedReason::TooLongAgo: return "TooLongAgo";
    case LocatedReason::NotSeenAgain: break;
  }
  return "NotSeenAgain";
}

Localiser::Localiser(const Parameters& parameters) : parameters_(parameters) {}

bool Localiser::addOdometry(const urban_nav_core::RelativePose& step) {
  if (!odometry_.append(step)) return false;
  steps_.push_back(step);
  if (steps_.size() >= most_steps) forgetOldSteps();
  return true;
}

void Localiser::forgetOldSteps() {
  steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(most_steps / 2));
  odometry_ = urban_nav_core::OdometryChain();
  for (const urban_nav_core::RelativePose& step : steps_) odometry_.append(step);
  const StampNs begin = steps_.front().from;
  const auto first = std::find_if(sightings_.begin(), sightings_.end(),
                                  [begin](const Sighting& sighting) { return sighting.stamp >= begin; });
  if (first == sightings_.begin()) return;
  sightings_.erase(sightings_.begin(), first);
  choose();
}

void Localiser::addSighting(StampNs b, const Pose& T_map_a, const Constraint& measured, bool is_firm) {
  Sighting sighting;
  sighting.stamp = b;
  const Matrix6d covariance = urban_nav_core::covarianceForDisplay(measured.information, sighting_metres_per_radian);
  const double sigma = parameters_.map_sigma;
  Matrix6d of_map = Matrix6d::Zero();
  of_map.diagonal() << Eigen::Vector3d::Constant(sigma * sigma),
      Eigen::Vector3d::Constant(sigma * sigma / (sighting_metres_per_radian * sighting_metres_per_radian));
  sighting.T_map_base = compose(PoseWithCovariance{T_map_a, of_map}, PoseWithCovariance{measured.T_a_b, covariance});
  sighting.begins = is_firm && positionSigma(sighting.T_map_base) < 1.0;
  if (sighting.T_map_base.pose.isFinite() && sighting.T_map_base.covariance.allFinite()) add(sighting);
}

void Localiser::addBelief(StampNs at, const PoseWithCovariance& T_map_base) {
  Sighting belief;
  belief.stamp = at;
  belief.T_map_base = T_map_base;
  belief.sees = false;
  if (T_map_base.pose.isFinite() && T_map_base.covariance.allFinite()) add(belief);
}

void Localiser::addNothing(StampNs, bool expected) {
  ++nothing_;
  if (expected) ++missed_;
}

void Localiser::add(const Sighting& sighting) {
  if (!odometry_.nearestFrame(sighting.stamp)) return;  // nobody knows where the robot was then
  nothing_ = 0;
  const auto place = std::upper_bound(sightings_.begin(), sightings_.end(), sighting,
                                      [](const Sighting& a, const Sighting& b) { return a.stamp < b.stamp; });
  sightings_.insert(place, sighting);
  if (sightings_.size() > most_sightings) sightings_.erase(sightings_.begin());
  choose();
  if (against() >= outvoting_witnesses) {
    sightings_.erase(sightings_.begin(), sightings_.begin() + static_cast<std::ptrdiff_t>(best_.members.back()) + 1);
    choose();
  }
  if (!best_.members.empty() && sightings_[best_.members.back()].stamp == sighting.stamp) missed_ = 0;
}

int Localiser::against() const {
  const auto newest = std::find_if(sightings_.rbegin(), sightings_.rend(),
                                   [](const Sighting& each) { return each.sees && each.begins; });
  if (newest == sightings_.rend() || best_.witnesses == 0) return 0;
  const auto last = best_.members.back();
  const Hypothesis other = around(static_cast<std::size_t>(sightings_.rend() - newest) - 1);
  return other.members.front() > last ? other.witnesses : 0;
}

bool Localiser::agree(const Sighting& one, const Sighting& other) const {
  const auto way = odometry_.between(one.stamp, other.stamp);
  if (!way) return false;
  PoseWithCovariance expected = compose(one.T_map_base, *way);
  const double common =
      parameters_.odometry_scale * std::abs(odometry_.distance(one.stamp) - odometry_.distance(other.stamp));
  expected.covariance.diagonal().head<3>().array() += common * common;
  expected.covariance += other.T_map_base.covariance;
  const auto squares = urban_nav_core::nees(other.T_map_base.pose, expected);
  return squares && std::sqrt(*squares / 6.0) <= parameters_.gate;
}

Localiser::Hypothesis Localiser::around(std::size_t sighting) const {
  Hypothesis made;
  double last = -1e9;
  if (!sightings_[sighting].sees) {
    made.members.push_back(sighting);  // a belief is no evidence: vague enough, it would agree with everything
    return made;
  }
  for (std::size_t i = 0; i < sightings_.size(); ++i) {
    if (i != sighting && (!sightings_[i].sees || !agree(sightings_[sighting], sightings_[i]))) continue;
    made.members.push_back(i);
    const double here = odometry_.distance(sightings_[i].stamp);
    if (here - last < apart) continue;
    ++made.witnesses;
    last = here;
  }
  return made;
}

void Localiser::choose() {
  std::vector<Hypothesis> all;
  for (std::size_t i = 0; i < sightings_.size(); ++i)
    if (sightings_[i].begins) all.push_back(around(i));
  // The most witnesses; of equally many the one that saw last.
  const auto better = [&](const Hypothesis& x, const Hypothesis& y) {
    return x.witnesses != y.witnesses ? x.witnesses > y.witnesses : x.members.back() > y.members.back();
  };
  best_ = second_ = Hypothesis();
  for (const Hypothesis& each : all)
    if (best_.members.empty() || better(each, best_)) best_ = each;
  for (const Hypothesis& each : all) {
    const bool shares = std::any_of(each.members.begin(), each.members.end(), [&](std::size_t member) {
      return std::find(best_.members.begin(), best_.members.end(), member) != best_.members.end();
    });
    if (!shares && (second_.members.empty() || better(each, second_))) second_ = each;
  }
}

PoseWithCovariance Localiser::fuse(const Hypothesis& hypothesis, StampNs stamp) const {
  // All of them brought to the last one, and from there on by odometry: its errors are in common to all.
  const Sighting& last = sightings_[hypothesis.members.back()];
  PoseWithCovariance sum = last.T_map_base;
  for (auto member = hypothesis.members.rbegin() + 1; member != hypothesis.members.rend(); ++member) {
    const Sighting& sighting = sightings_[*member];
    const auto way = odometry_.between(sighting.stamp, last.stamp);
    if (!way) continue;
    PoseWithCovariance there = compose(sighting.T_map_base, *way);
    const double common =
        parameters_.odometry_scale * std::abs(odometry_.distance(last.stamp) - odometry_.distance(sighting.stamp));
    there.covariance.diagonal().head<3>().array() += common * common;
    // Kalman's update with one more measurement of the whole pose.
    const auto inverse = urban_nav_core::invertPositiveDefinite(Matrix6d(sum.covariance + there.covariance));
    if (!inverse) continue;
    const Matrix6d gain = sum.covariance * *inverse;
    const Vector6d d = boxMinus(there.pose, sum.pose);
    sum.pose = boxPlus(sum.pose, gain * d);
    const Matrix6d covariance = sum.covariance - gain * sum.covariance;
    sum.covariance = 0.5 * (covariance + covariance.transpose());
  }
  // What the map itself may be wrong is in common to all of them.
  const double sigma = parameters_.map_sigma;
  sum.covariance.diagonal().head<3>().array() += sigma * sigma;
  const auto way = odometry_.between(last.stamp, stamp);
  if (!way) return sum;
  PoseWithCovariance now = compose(sum, *way);
  const double common =
      parameters_.odometry_scale * std::abs(odometry_.distance(stamp) - odometry_.distance(last.stamp));
  now.covariance.diagonal().head<3>().array() += common * common;
  return now;
}

double Localiser::unseen() const {
  if (odometry_.empty()) return 0.0;
  const double driven = odometry_.distance(odometry_.trajectory().back().stamp);
  const auto last =
      std::find_if(sightings_.rbegin(), sightings_.rend(), [](const Sighting& sighting) { return sighting.sees; });
  return last == sightings_.rend() ? driven : driven - odometry_.distance(last->stamp);
}

Located Localiser::now() const { return odometry_.empty() ? Located() : at(odometry_.trajectory().back().stamp); }

Located Localiser::at(StampNs stamp) const {
  Located located;
  located.stamp = stamp;
  const auto because = [&](Knowledge knowledge, LocatedReason reason, const std::string& sentence) {
    located.knowledge = knowledge;
    located.reason = reason;
    located.sentence = sentence;
    return located;
  };
  const bool looks_in_vain = nothing_ >= looks_for_new;
  if (best_.members.empty() || !odometry_.nearestFrame(stamp))
    return looks_in_vain
               ? because(Knowledge::New, LocatedReason::NothingAlike, "nothing here looks like the map")
               : because(Knowledge::Unsure, LocatedReason::NothingSeen, "nothing in the map was recognised yet");
  located.T_map_base = fuse(best_, stamp);
  located.witnesses = best_.witnesses;
  located.probability = probabilityOf(best_.witnesses, second_.witnesses);
  const double sigma = positionSigma(*located.T_map_base);
  if (best_.witnesses == 0)
    return because(Knowledge::Unsure, LocatedReason::BeliefAlone, "somebody says so, and nothing was seen of it");
  if (best_.witnesses < enough)
    return because(Knowledge::Unsure, LocatedReason::OneSighting, "one sighting, and no second one that agrees");
  if (second_.witnesses >= best_.witnesses || against() >= enough)
    return because(Knowledge::Unsure, LocatedReason::Contested, "as many sightings say that it is elsewhere");
  if (missed_ >= looks_for_new)
    return because(Knowledge::Unsure, LocatedReason::NotSeenAgain, "the map's views of this place show something else");
  if (sigma > known_sigma)
    return because(looks_in_vain ? Knowledge::New : Knowledge::Unsure, LocatedReason::TooLongAgo,
                   "the last sighting is too long ago: odometry is good to " + metres(sigma));
  return because(Knowledge::Known, LocatedReason::None,
                 std::to_string(best_.witnesses) + " sightings agree, to " + metres(sigma));
}

}  // namespace loop_metric
