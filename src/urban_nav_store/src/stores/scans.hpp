// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>

#include "schema/table_access.hpp"
#include "urban_nav_store/scan_store.hpp"

namespace urban_nav_store {

/// The open block of each laser is kept in memory until another second begins or before a commit, and then replaces
/// that of the file.
class SqliteScanStore : public ScanStore {
 public:
  explicit SqliteScanStore(TableAccess& tables) : tables_(tables) {}

  void put(const SessionId& session, const std::string& laser, const urban_nav_core::Scan& scan) override;
  std::vector<std::string> lasers(const SessionId& session) const override;
  std::int64_t count(const SessionId& session, const std::string& laser) const override;
  void forEach(const SessionId& session, const std::string& laser, urban_nav_core::StampNs from,
               urban_nav_core::StampNs to, const std::function<void(const urban_nav_core::Scan&)>& take) const override;

  /// Writes buffered blocks into the transaction, before a commit.
  void flush() const;
  /// Discards buffered blocks, after a rollback.
  void forget() { open_.clear(); }

 private:
  struct Block {
    std::int64_t second = 0;
    std::vector<urban_nav_core::Scan> scans;  // in order of time
    bool changed = false;
  };
  using Key = std::pair<SessionId, std::string>;

  Block load(const Key& key, std::int64_t second) const;
  void save(const Key& key, Block& block) const;

  TableAccess& tables_;
  mutable std::map<Key, Block> open_;
};

}  // namespace urban_nav_store
