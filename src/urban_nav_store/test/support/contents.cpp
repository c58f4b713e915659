// SPDX-License-Identifier: BSD-3-Clause
#include "support/contents.hpp"

#include "urban_nav_core/geometry/so3.hpp"

namespace urban_nav_store::testing {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

Session Drawn::session() {
  SessionOrigin origin{"lisa", "run " + std::to_string(random_()),
                       1225719873501685123 + static_cast<StampNs>(random_()), "digest"};
  return {makeSessionId(origin), "a \"session\" with ' and \n in its name",
          origin.robot,          origin.recording,
          origin.start,          random_() % 2 == 0};
}

Pose Drawn::pose() {
  std::normal_distribution<double> n;
  return {urban_nav_core::expSo3({n(random_), n(random_), n(random_)}),
          {n(random_), 1e3 * n(random_), 1e-9 * n(random_)}};
}

Matrix6d Drawn::matrix() {
  std::normal_distribution<double> n;
  Matrix6d root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = n(random_);
  return root * root.transpose();
}

Node Drawn::node(StampNs stamp) {
  return {stamp, pose(), matrix(), matrix(),
          random_() % 3 == 0 ? urban_nav_core::Health::Lost : urban_nav_core::Health::Ok};
}

RelaxedPose Drawn::relaxed(StampNs stamp) { return {stamp, pose(), static_cast<std::int64_t>(random_() % 100)}; }

Edge Drawn::edge(const NodeRef& a, const NodeRef& b, EdgeKind kind) {
  Edge edge{a, b, kind, "drawn", {pose(), matrix()}, 0.25, ClosureVerdict::Rejected, "too far, \"perhaps\""};
  return edge;
}

urban_nav_core::Scan Drawn::scan(StampNs stamp, int beams) {
  std::uniform_real_distribution<float> u(0.0F, 30.0F);
  urban_nav_core::Scan scan;
  scan.stamp = stamp;
  for (int i = 0; i < beams; ++i) {
    const float angle = 3.14159265F * static_cast<float>(i) / 180.0F;
    scan.beams.push_back({stamp + 18500 * i, {std::cos(angle), std::sin(angle), 0.0F}, u(random_), u(random_)});
  }
  return scan;
}

std::string Drawn::bytes(std::size_t size) {
  std::string text;
  for (std::size_t i = 0; i < size; ++i) text += static_cast<char>(random_() & 0xffU);
  return text;
}

SessionId fill(Store& store, std::uint32_t seed, int nodes) {
  Drawn drawn(seed);
  const Session session = drawn.session();
  store.sessions().put(session);
  store.sessions().put(session.id, StoredParameter{"swf_vo.window", "25", "--set swf_vo.window=25"});
  store.sessions().put(session.id, Property{"version", "1.2"});
  store.sessions().put(session.id, Extrinsic{"laser_left", drawn.pose()});
  store.sessions().put(Anchor{session.id, session.id, 3, drawn.pose()});
  StampNs last = 0;
  for (int i = 0; i < nodes; ++i) {
    const StampNs stamp = session.start + 50'000'001 * StampNs{i};
    store.graph().put(session.id, drawn.node(stamp));
    store.graph().put(session.id, drawn.relaxed(stamp));
    store.inputs().append(session.id, {i % 3 == 0 ? "laser_left" : "stereo", stamp, i % 7 != 0});
    store.scans().put(session.id, "laser_left", drawn.scan(stamp, 20));
    if (i % 5 == 0) store.keyframes().put(session.id, "left", {stamp, drawn.bytes(200), drawn.bytes(50)});
    if (i > 0) store.graph().put(drawn.edge({session.id, last}, {session.id, stamp}, EdgeKind::Odometry));
    last = stamp;
  }
  const Edge closure = drawn.edge({session.id, session.start}, {session.id, last}, EdgeKind::Stereo);
  store.graph().put(closure);
  store.graph().putEvidence(closure, drawn.bytes(5000));
  store.states().put(session.id, "swf_vo", drawn.bytes(20000));
  return session.id;
}

}  // namespace urban_nav_store::testing
