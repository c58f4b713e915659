// SPDX-License-Identifier: BSD-3-Clause
#include "stores/graph.hpp"

#include "blocks/deflate.hpp"
#include "schema/row.hpp"
#include "stores/checks.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

constexpr std::size_t kMostEvidence = std::size_t{1} << 29;
constexpr const char* kBetween = "WHERE session=? AND stamp_ns>=? AND stamp_ns<=?";

std::string nameOf(const SessionId& session, StampNs stamp) {
  return "node " + urban_nav_core::printStamp(stamp) + " of session " + session;
}

std::string nameOf(const Edge& edge) {
  return std::string(toString(edge.kind)) + " edge from " + nameOf(edge.a.session, edge.a.stamp) + " to " +
         nameOf(edge.b.session, edge.b.stamp);
}

Node readNode(RowReader& reader) {
  Node node;
  reader.text();
  node.stamp = reader.integer();
  node.T_odom_base = reader.pose();
  const auto status = urban_nav_core::parseHealth(reader.text());
  if (!status) reader.damaged("a status is no such word");
  node.status = *status;
  if (!matrixOf(reader.blob(), node.covariance)) reader.damaged("a covariance is no matrix");
  if (!matrixOf(reader.blob(), node.drift_covariance)) reader.damaged("a covariance is no matrix");
  return node;
}

RelaxedPose readRelaxed(RowReader& reader) {
  RelaxedPose pose;
  reader.text();
  pose.stamp = reader.integer();
  pose.T_map_base = reader.pose();
  pose.revision = reader.integer();
  return pose;
}

Edge readEdge(RowReader& reader) {
  Edge edge;
  edge.a.session = reader.text();
  edge.a.stamp = reader.integer();
  edge.b.session = reader.text();
  edge.b.stamp = reader.integer();
  const auto kind = parseEdgeKind(reader.text());
  if (!kind) reader.damaged("a kind of edge is no such word");
  edge.kind = *kind;
  edge.source = reader.text();
  edge.measured.T_a_b = reader.pose();
  if (!matrixOf(reader.blob(), edge.measured.information)) reader.damaged("an information is no matrix");
  edge.weight = reader.real();
  const auto verdict = urban_nav_core::parseClosureVerdict(reader.text());
  if (!verdict || *verdict == urban_nav_core::ClosureVerdict::Degenerate) reader.damaged("a verdict is no such word");
  edge.verdict = *verdict;
  edge.reason = reader.text();
  return edge;
}

/// Rows of a session within stamps; the tally is compared where they are all of it.
template <typename Take>
void readBetween(Connection& connection, const Table& table, const SessionId& session, StampNs from, StampNs to,
                 const Take& take) {
  RowReader reader(connection, table, kBetween);
  reader.statement().bind(0, session);
  reader.statement().bind(1, from);
  reader.statement().bind(2, to);
  while (reader.next()) take(reader);
  if (from == GraphStore::kFirst && to == GraphStore::kLast) verifyTally(reader, session);
}

RowWriter& key(RowWriter& writer, const Edge& edge, const char* kind) {
  return writer.text(edge.a.session)
      .integer(edge.a.stamp)
      .text(edge.b.session)
      .integer(edge.b.stamp)
      .text(kind)
      .text(edge.source);
}

void bindKey(Statement& statement, const Edge& edge, const char* kind) {
  statement.bind(0, edge.a.session);
  statement.bind(1, edge.a.stamp);
  statement.bind(2, edge.b.session);
  statement.bind(3, edge.b.stamp);
  statement.bind(4, std::string_view(kind));
  statement.bind(5, edge.source);
}

}  // namespace

bool operator==(const NodeRef& a, const NodeRef& b) { return a.session == b.session && a.stamp == b.stamp; }

void Graph::put(const SessionId& session, const Node& node) {
  refuseNotFinite(connection_, nameOf(session, node.stamp), node.T_odom_base);
  refuseNotFinite(connection_, nameOf(session, node.stamp), node.covariance);
  refuseNotFinite(connection_, nameOf(session, node.stamp), node.drift_covariance);
  const std::string covariance = bytesOf(node.covariance), drift = bytesOf(node.drift_covariance);
  RowWriter(connection_, putSql(schema::node()))
      .text(session)
      .integer(node.stamp)
      .pose(node.T_odom_base)
      .text(toString(node.status))
      .blob(covariance)
      .blob(drift)
      .write();
}

std::optional<Node> Graph::node(const NodeRef& ref) const {
  std::optional<Node> found;
  readBetween(connection_, schema::node(), ref.session, ref.stamp, ref.stamp,
              [&](RowReader& reader) { found = readNode(reader); });
  return found;
}

std::int64_t Graph::nodes(const SessionId& session) const {
  Statement statement = connection_.prepare("SELECT count FROM tally WHERE name='node' AND session=?");
  statement.bind(0, session);
  return statement.step() ? statement.integer(0) : 0;
}

void Graph::forEachNode(const SessionId& session, const std::function<void(const Node&)>& take, Stamp from,
                        Stamp to) const {
  readBetween(connection_, schema::node(), session, from, to, [&](RowReader& reader) { take(readNode(reader)); });
}

void Graph::put(const SessionId& session, const RelaxedPose& pose) {
  refuseNotFinite(connection_, "relaxed " + nameOf(session, pose.stamp), pose.T_map_base);
  RowWriter(connection_, putSql(schema::relaxed()))
      .text(session)
      .integer(pose.stamp)
      .pose(pose.T_map_base)
      .integer(pose.revision)
      .write();
}

void Graph::forEachRelaxed(const SessionId& session, const std::function<void(const RelaxedPose&)>& take, Stamp from,
                           Stamp to) const {
  readBetween(connection_, schema::relaxed(), session, from, to, [&](RowReader& reader) { take(readRelaxed(reader)); });
}

void Graph::put(const Edge& edge) {
  refuseNotFinite(connection_, nameOf(edge), edge.measured.T_a_b);
  refuseNotFinite(connection_, nameOf(edge), edge.measured.information);
  refuseNotFinite(connection_, nameOf(edge), edge.weight);
  const std::string information = bytesOf(edge.measured.information);
  RowWriter writer(connection_, putSql(schema::edge()));
  key(writer, edge, toString(edge.kind))
      .pose(edge.measured.T_a_b)
      .blob(information)
      .real(edge.weight)
      .text(toString(edge.verdict))
      .text(edge.reason)
      .write();
}

void Graph::remove(const Edge& edge) {
  connection_.beginWriting();
  for (const Table* table : {&schema::edge(), &schema::evidence()}) {
    Statement statement = connection_.prepare("DELETE FROM " + std::string(table->name) + " WHERE " + keySql(*table));
    bindKey(statement, edge, toString(edge.kind));
    statement.step();
  }
}

void Graph::forEachEdge(const SessionId& session_a, const std::function<void(const Edge&)>& take) const {
  RowReader reader(connection_, schema::edge(), "WHERE session_a=?");
  reader.statement().bind(0, session_a);
  while (reader.next()) take(readEdge(reader));
  verifyTally(reader, session_a);
}

void Graph::putEvidence(const Edge& edge, const std::string& bytes) {
  if (bytes.size() > kMostEvidence)
    throw UserError(connection_.name(), "the evidence of the " + nameOf(edge) + " is too long", "at most 512 MB");
  const std::string packed = deflated(bytes);
  RowWriter writer(connection_, putSql(schema::evidence()));
  key(writer, edge, toString(edge.kind)).blob(packed).write();
}

std::optional<std::string> Graph::evidence(const Edge& edge) const {
  const Table& table = schema::evidence();
  RowReader reader(connection_, table, "WHERE " + keySql(table));
  bindKey(reader.statement(), edge, toString(edge.kind));
  std::optional<std::string> bytes;
  while (reader.next()) {
    for (int i = 0; i < 2; ++i) reader.text(), reader.integer();
    reader.text();
    reader.text();
    bytes = inflated(reader.blob(), kMostEvidence);
    if (!bytes) reader.damaged("a piece of evidence cannot be unpacked");
  }
  return bytes;
}

}  // namespace urban_nav_store
