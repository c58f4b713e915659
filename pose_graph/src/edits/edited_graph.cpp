// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/edited_graph.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/map_levels.hpp"

namespace pose_graph {

using urban_nav_core::Matrix6d;

namespace {

constexpr int kPinRounds = 5;     // limit of relaxations with pins; the first one is usually accurate to millimetres
constexpr double kPlaced = 1e-6;  // m: convergence of pins

using Name = std::tuple<SessionId, StampNs, SessionId, StampNs, EdgeKind, std::string>;

Name edgeName(const Edit& edit) {
  return {edit.a.session, edit.a.stamp, edit.b.session, edit.b.stamp, edit.kind, edit.source};
}

bool names(const Edit& edit, const Closure& closure) {
  return edit.a == closure.a && edit.b == closure.b && edit.kind == closure.kind && edit.source == closure.source;
}

bool isVerdict(const Edit& edit) { return edit.action == Edit::Action::Reject || edit.action == Edit::Action::Accept; }

/// Sorts edits by number. Leaves out closures that are removed later, and all but the last verdict on a closure.
std::vector<Edit> standing(std::vector<Edit> edits) {
  std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.number < b.number; });
  std::vector<Edit> result;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const Edit& edit = edits[i];
    const bool overruled =
        std::any_of(edits.begin() + static_cast<std::ptrdiff_t>(i) + 1, edits.end(), [&](const Edit& later) {
          if (isVerdict(edit)) return isVerdict(later) && edgeName(later) == edgeName(edit);
          if (edit.action == Edit::Action::Add)
            return (later.action == Edit::Action::Remove || later.action == Edit::Action::Add) &&
                   edgeName(later) == edgeName(edit);
          return edit.action == Edit::Action::Pin && later.action == Edit::Action::Remove &&
                 edgeName(later) == edgeName(edit);
        });
    if (!overruled && edit.action != Edit::Action::Remove) result.push_back(edit);
  }
  return result;
}

/// Returns the information on T_a_b of a point of b measured in a: J^T J / sigma^2 with the displacement J (rho, phi)
/// of the point.
Matrix6d pointInformation(const Eigen::Vector3d& p_turned, double sigma) {
  Eigen::Matrix<double, 3, 6> J;
  J.leftCols<3>().setIdentity();
  J.rightCols<3>() << 0.0, p_turned.z(), -p_turned.y(), -p_turned.z(), 0.0, p_turned.x(), p_turned.y(), -p_turned.x(),
      0.0;
  return J.transpose() * J / (sigma * sigma);
}

}  // namespace

EditedGraph::EditedGraph(PoseGraph& graph, std::vector<Edit> edits)
    : graph_(graph), edits_(standing(std::move(edits))) {
  for (const Edit& edit : edits_) without_effect_.insert(edit.number);
}

bool EditedGraph::addOdometry(const SessionId& session, const urban_nav_core::RelativePose& step) {
  for (const Edit& edit : edits_) {
    if (edit.action != Edit::Action::Cut || edit.a.session != session) continue;
    if (step.from > edit.a.stamp || step.to <= edit.a.stamp) continue;
    without_effect_.erase(edit.number);
    return false;
  }
  return graph_.addOdometry(session, step);
}

const Edit* EditedGraph::findVerdict(const Closure& closure) const {
  for (const Edit& edit : edits_)
    if (isVerdict(edit) && names(edit, closure)) return &edit;
  return nullptr;
}

std::optional<ClosureId> EditedGraph::addClosure(const Closure& offered) {
  const Edit* verdict = findVerdict(offered);
  if (verdict != nullptr) without_effect_.erase(verdict->number);
  if (verdict != nullptr && verdict->action == Edit::Action::Reject) {
    Closure rejected = offered;
    rejected.weight = 0.0;
    rejected.verdict = ClosureVerdict::Rejected;
    rejected.reason = "rejected by hand";
    rejected_.push_back(std::move(rejected));
    return std::nullopt;
  }
  const ClosureId id = graph_.addClosure(offered);
  if (verdict != nullptr) accepts_.emplace_back(id, verdict);
  return id;
}

void EditedGraph::addOwnClosures() {
  std::vector<const Edit*> own;
  const auto place = [this](const SessionId& session) { return graph_.track(session) - graph_.tracks().data(); };
  for (const Edit& edit : edits_) {
    const bool there = graph_.poseNumber(edit.a) && graph_.poseNumber(edit.b);
    if (there && (edit.action == Edit::Action::Origin || edit.action == Edit::Action::Pin))
      without_effect_.erase(edit.number);
    if (there && edit.action == Edit::Action::Add) own.push_back(&edit);
  }
  // In an order that depends on their content only, not on the order of the edits.
  std::stable_sort(own.begin(), own.end(), [&](const Edit* a, const Edit* b) {
    return std::make_tuple(place(a->a.session), a->a.stamp, place(a->b.session), a->b.stamp, a->kind, a->source) <
           std::make_tuple(place(b->a.session), b->a.stamp, place(b->b.session), b->b.stamp, b->kind, b->source);
  });
  for (const Edit* edit : own) {
    without_effect_.erase(edit->number);
    Closure closure;
    closure.a = edit->a;
    closure.b = edit->b;
    closure.kind = edit->kind;
    closure.source = edit->source;
    closure.measured = edit->measured;
    closure.by_hand = true;
    const Edit* verdict = findVerdict(closure);
    if (verdict != nullptr && verdict->action == Edit::Action::Reject) {
      addClosure(closure);
      own_.push_back({-static_cast<ClosureId>(rejected_.size()), edit});
    } else {
      own_.push_back({graph_.addClosure(closure), edit});
    }
  }
}

void EditedGraph::vouch(ClosureId id, bool by_hand) {
  Closure closure = graph_.closures().at(id);
  if (closure.by_hand == by_hand) return;
  closure.by_hand = by_hand;
  graph_.addClosure(closure);
}

bool EditedGraph::forceAccepted() {
  bool any = false;
  for (const auto& [id, edit] : accepts_) {
    if (graph_.closures().at(id).verdict == ClosureVerdict::Accepted || graph_.closures().at(id).by_hand) continue;
    vouch(id, true);
    any = true;
  }
  return any;
}

std::optional<NodeRef> EditedGraph::origin(const SessionId& session) const {
  const Track* track = graph_.track(session);
  if (track == nullptr) return std::nullopt;
  const auto findItsMap = [this](const Track* of) {
    return findMap(graph_.tracks(), static_cast<std::size_t>(of - graph_.tracks().data()));
  };
  std::optional<NodeRef> found;
  for (const Edit& edit : edits_)
    if (edit.action == Edit::Action::Origin && graph_.poseNumber(edit.a) &&
        findItsMap(graph_.track(edit.a.session)) == findItsMap(track))
      found = edit.a;
  return found;
}

void EditedGraph::removePins() {
  for (const ClosureId id : pins_) graph_.removeClosure(id);
  pins_.clear();
}

double EditedGraph::placePins(const std::function<Pose(const SessionId&)>& T_map_graph) {
  const auto poseAt = [this](const NodeRef& ref) {
    const Track& track = *graph_.track(ref.session);
    return track.map[static_cast<std::size_t>(std::lower_bound(track.stamps.begin(), track.stamps.end(), ref.stamp) -
                                              track.stamps.begin())];
  };
  double moved = 0.0;
  std::vector<ClosureId> placed;
  for (const Edit& edit : edits_) {
    if (edit.action != Edit::Action::Pin || !graph_.poseNumber(edit.a)) continue;
    const Track* track = graph_.track(edit.a.session);
    const Track& map =
        graph_.tracks()[findMap(graph_.tracks(), static_cast<std::size_t>(track - graph_.tracks().data()))];
    Closure pin;
    pin.a = origin(edit.a.session).value_or(NodeRef{map.session, map.stamps.front()});
    pin.b = edit.a;
    if (pin.a == pin.b) continue;  // the origin itself
    pin.kind = EdgeKind::Asserted;
    pin.source = edit.source;
    pin.by_hand = true;
    const Pose T_graph_a = poseAt(pin.a), T_a_b = T_graph_a.inverse() * poseAt(pin.b);
    const Eigen::Vector3d p_a = (T_map_graph(edit.a.session) * T_graph_a).inverse() * edit.p_map,
                          p_turned = T_a_b.q() * edit.p_base;
    pin.measured = {Pose(T_a_b.q(), p_a - p_turned), pointInformation(p_turned, edit.sigma)};
    const auto earlier = graph_.findClosure(pin.a, pin.b, pin.kind, pin.source);
    const Closure* before = earlier ? &graph_.closures().at(*earlier) : nullptr;
    moved = std::max(moved, before == nullptr ? std::numeric_limits<double>::infinity()
                                              : distanceBetween(before->measured.T_a_b, pin.measured.T_a_b));
    placed.push_back(graph_.addClosure(pin));
  }
  for (const ClosureId id : pins_)
    if (std::find(placed.begin(), placed.end(), id) == placed.end()) graph_.removeClosure(id);
  pins_ = std::move(placed);
  return moved;
}

void EditedGraph::relax(const std::function<void()>& relax, const std::function<Pose(const SessionId&)>& T_map_graph) {
  removePins();
  for (const auto& [id, edit] : accepts_) vouch(id, false);
  relax();
  while (forceAccepted()) relax();
  for (int round = 0; round < kPinRounds; ++round) {
    if (placePins(T_map_graph) <= kPlaced) break;
    relax();
    while (forceAccepted()) relax();
  }
}

std::vector<std::string> EditedGraph::warnings() const {
  std::vector<std::string> result;
  for (const Edit& edit : edits_)
    if (without_effect_.count(edit.number) > 0)
      result.push_back("edit " + std::to_string(edit.number) + " has no effect: its " +
                       (isVerdict(edit) || edit.action == Edit::Action::Add ? "closure" : "pose") +
                       " is not in this map");
  return result;
}

}  // namespace pose_graph
