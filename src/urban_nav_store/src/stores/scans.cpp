// SPDX-License-Identifier: BSD-3-Clause
#include "stores/scans.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "blocks/scan_block.hpp"
#include "tables/measurement_tables.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::Beam;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kSecond = 1'000'000'000;
constexpr std::size_t kBlocksAtOnce = 8;  // unpacked at a time, on all threads

/// Returns the second of a stamp, also before 1970.
std::int64_t wholeSecond(StampNs stamp) { return stamp / kSecond - (stamp % kSecond < 0 ? 1 : 0); }

std::vector<Scan> intact(std::optional<std::vector<Scan>> scans, const ScanBlockRow& row,
                         const Connection& connection) {
  if (!scans || static_cast<std::int64_t>(scans->size()) != row.scans)
    connection.damaged("in table scan, a block of scans cannot be unpacked");
  return std::move(*scans);
}

}  // namespace

void SqliteScanStore::put(const SessionId& session, const std::string& laser, const Scan& scan) {
  for (const Beam& beam : scan.beams) {
    if (beam.direction.allFinite() && std::isfinite(beam.range) && std::isfinite(beam.intensity)) continue;
    throw urban_nav_core::UserError(
        tables_.connection().name(),
        "scan " + urban_nav_core::printStamp(scan.stamp) + " of " + laser + " has a beam that is not finite",
        "finite numbers");
  }
  tables_.connection().beginWriting();
  const Key key(session, laser);
  const std::int64_t second = wholeSecond(scan.stamp);
  const auto known = open_.find(key);
  if (known == open_.end() || known->second.second != second) {
    if (known != open_.end()) save(key, known->second);
    open_[key] = load(key, second);
  }
  Block& block = open_[key];
  const auto place = std::lower_bound(block.scans.begin(), block.scans.end(), scan.stamp,
                                      [](const Scan& each, StampNs stamp) { return each.stamp < stamp; });
  if (place != block.scans.end() && place->stamp == scan.stamp) {
    *place = scan;
  } else {
    block.scans.insert(place, scan);
  }
  block.changed = true;
}

SqliteScanStore::Block SqliteScanStore::load(const Key& key, std::int64_t second) const {
  Block block;
  block.second = second;
  ScanBlockRow row{key.first, key.second, second, 0, ""};
  if (tables_.find(declaredTable<ScanBlockRow>(), AnyRow(row)))
    block.scans = intact(unpackScans(row.data), row, tables_.connection());
  return block;
}

void SqliteScanStore::save(const Key& key, Block& block) const {
  if (!block.changed) return;
  tables_.put(declaredTable<ScanBlockRow>(),
              unchanged(ScanBlockRow{key.first, key.second, block.second, static_cast<std::int64_t>(block.scans.size()),
                                     packScans(block.scans)}));
  block.changed = false;
}

void SqliteScanStore::flush() const {
  for (auto& [key, block] : open_) save(key, block);
}

std::vector<std::string> SqliteScanStore::lasers(const SessionId& session) const {
  flush();
  return tables_.secondKeys(declaredTable<ScanBlockRow>(), session);
}

std::int64_t SqliteScanStore::count(const SessionId& session, const std::string& laser) const {
  flush();
  Statement statement =
      tables_.connection().prepare("SELECT COALESCE(SUM(scans),0) FROM scan WHERE session=? AND laser=?");
  statement.bind(0, session);
  statement.bind(1, laser);
  return statement.step() ? statement.integer(0) : 0;
}

void SqliteScanStore::forEach(const SessionId& session, const std::string& laser, StampNs from, StampNs to,
                              const std::function<void(const Scan&)>& take) const {
  flush();
  tables_.verifyOnce(declaredTable<ScanBlockRow>(), session);
  std::vector<ScanBlockRow> blocks;
  const auto unpackAll = [&] {
    std::vector<std::optional<std::vector<Scan>>> scans(blocks.size());
    urban_nav_core::forEach(blocks.size(), 1, [&](std::size_t i) { scans[i] = unpackScans(blocks[i].data); });
    for (std::size_t i = 0; i < blocks.size(); ++i)
      for (const Scan& scan : intact(std::move(scans[i]), blocks[i], tables_.connection()))
        if (scan.stamp >= from && scan.stamp <= to) take(scan);
    blocks.clear();
  };
  ScanBlockRow row{session, laser, 0, 0, ""};
  tables_.forEachBetween(declaredTable<ScanBlockRow>(), AnyRow(row), wholeSecond(from), wholeSecond(to), [&] {
    blocks.push_back(row);
    if (blocks.size() == kBlocksAtOnce) unpackAll();
  });
  unpackAll();
}

}  // namespace urban_nav_store
