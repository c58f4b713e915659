// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "schema/table_access.hpp"
#include "urban_nav_store/graph_store.hpp"

namespace urban_nav_store {

class SqliteGraphStore : public GraphStore {
 public:
  explicit SqliteGraphStore(TableAccess& tables) : tables_(tables) {}

  void put(const SessionId& session, const Node& node) override;
  std::optional<Node> node(const NodeRef& ref) const override;
  std::int64_t nodes(const SessionId& session) const override;
  void forEachNode(const SessionId& session, const std::function<void(const Node&)>& take, Stamp from,
                   Stamp to) const override;
  void put(const SessionId& session, const RelaxedPose& pose) override;
  void forEachRelaxed(const SessionId& session, const std::function<void(const RelaxedPose&)>& take, Stamp from,
                      Stamp to) const override;
  void put(const Edge& edge) override;
  void remove(const Edge& edge) override;
  void forEachEdge(const SessionId& session_a, const std::function<void(const Edge&)>& take) const override;
  void putEvidence(const Edge& edge, const std::string& bytes) override;
  std::optional<std::string> evidence(const Edge& edge) const override;

 private:
  TableAccess& tables_;
};

}  // namespace urban_nav_store
