// SPDX-License-Identifier: BSD-3-Clause
#include "stores/scans.hpp"

#include <algorithm>
#include <cmath>

#include "blocks/scan_block.hpp"
#include "schema/row.hpp"
#include "stores/checks.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::Beam;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kSecond = 1'000'000'000;

/// The second that a stamp is in, also before 1970.
std::int64_t secondOf(StampNs stamp) { return stamp / kSecond - (stamp % kSecond < 0 ? 1 : 0); }

std::vector<Scan> readBlock(RowReader& reader, std::int64_t& second) {
  reader.text();
  reader.text();
  second = reader.integer();
  const std::int64_t count = reader.integer();
  std::optional<std::vector<Scan>> scans = unpackScans(reader.blob());
  if (!scans || static_cast<std::int64_t>(scans->size()) != count)
    reader.damaged("a block of scans cannot be unpacked");
  return std::move(*scans);
}

}  // namespace

void Scans::put(const SessionId& session, const std::string& laser, const Scan& scan) {
  for (const Beam& beam : scan.beams) {
    if (beam.direction.allFinite() && std::isfinite(beam.range) && std::isfinite(beam.intensity)) continue;
    throw urban_nav_core::UserError(
        connection_.name(),
        "scan " + urban_nav_core::printStamp(scan.stamp) + " of " + laser + " has a beam that is not finite",
        "finite numbers");
  }
  connection_.beginWriting();
  const Key key(session, laser);
  const std::int64_t second = secondOf(scan.stamp);
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

Scans::Block Scans::load(const Key& key, std::int64_t second) const {
  Block block;
  block.second = second;
  RowReader reader(connection_, schema::scan(), "WHERE " + keySql(schema::scan()));
  reader.statement().bind(0, key.first);
  reader.statement().bind(1, key.second);
  reader.statement().bind(2, second);
  std::int64_t ignored = 0;
  while (reader.next()) block.scans = readBlock(reader, ignored);
  return block;
}

void Scans::save(const Key& key, Block& block) const {
  if (!block.changed) return;
  const std::string bytes = packScans(block.scans);
  RowWriter(connection_, putSql(schema::scan()))
      .text(key.first)
      .text(key.second)
      .integer(block.second)
      .integer(static_cast<std::int64_t>(block.scans.size()))
      .blob(bytes)
      .write();
  block.changed = false;
  whole_.erase(key.first);
}

void Scans::flush() const {
  for (auto& [key, block] : open_) save(key, block);
}

std::vector<std::string> Scans::lasers(const SessionId& session) const {
  flush();
  std::vector<std::string> names;
  Statement statement = connection_.prepare("SELECT DISTINCT laser FROM scan WHERE session=? ORDER BY laser");
  statement.bind(0, session);
  while (statement.step()) names.emplace_back(statement.text(0));
  return names;
}

std::int64_t Scans::count(const SessionId& session, const std::string& laser) const {
  flush();
  Statement statement = connection_.prepare("SELECT COALESCE(SUM(scans),0) FROM scan WHERE session=? AND laser=?");
  statement.bind(0, session);
  statement.bind(1, laser);
  return statement.step() ? statement.integer(0) : 0;
}

void Scans::forEach(const SessionId& session, const std::string& laser, StampNs from, StampNs to,
                    const std::function<void(const Scan&)>& take) const {
  flush();
  if (whole_.count(session) == 0) verifyTally(connection_, schema::scan(), session);
  whole_.insert(session);
  RowReader reader(connection_, schema::scan(), "WHERE session=? AND laser=? AND second>=? AND second<=?");
  reader.statement().bind(0, session);
  reader.statement().bind(1, laser);
  reader.statement().bind(2, secondOf(from));
  reader.statement().bind(3, secondOf(to));
  while (reader.next()) {
    std::int64_t second = 0;
    for (const Scan& scan : readBlock(reader, second))
      if (scan.stamp >= from && scan.stamp <= to) take(scan);
  }
}

}  // namespace urban_nav_store
