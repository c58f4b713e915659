// SPDX-License-Identifier: BSD-3-Clause
#include "stores/inputs.hpp"

#include "blocks/event_block.hpp"
#include "tables/measurement_tables.hpp"

namespace urban_nav_store {

namespace {

constexpr std::size_t kEvents = 4096;  // per block: about ten seconds of all sensors

std::vector<InputEvent> unpackEventBlock(const InputBlockRow& row, const Connection& connection) {
  std::optional<std::vector<InputEvent>> events = unpackEvents(row.data);
  if (!events || static_cast<std::int64_t>(events->size()) != row.events)
    connection.damaged("in table input, a block of input events cannot be unpacked");
  return std::move(*events);
}

}  // namespace

bool operator==(const InputEvent& a, const InputEvent& b) {
  return a.stream == b.stream && a.stamp == b.stamp && a.used == b.used;
}

void SqliteInputOrder::append(const SessionId& session, const InputEvent& event) {
  tables_.connection().beginWriting();
  auto found = open_.find(session);
  if (found == open_.end()) found = open_.emplace(session, last(session)).first;
  Block& block = found->second;
  if (block.events.size() >= kEvents) {
    save(session, block);
    block.events.clear();
    ++block.number;
  }
  block.events.push_back(event);
  block.changed = true;
}

SqliteInputOrder::Block SqliteInputOrder::last(const SessionId& session) const {
  Block block;
  InputBlockRow row{session, 0, 0, ""};
  if (tables_.findLast(declaredTable<InputBlockRow>(), AnyRow(row))) {
    block.number = row.block;
    block.events = unpackEventBlock(row, tables_.connection());
  }
  return block;
}

void SqliteInputOrder::save(const SessionId& session, Block& block) const {
  if (!block.changed) return;
  tables_.put(declaredTable<InputBlockRow>(),
              unchanged(InputBlockRow{session, block.number, static_cast<std::int64_t>(block.events.size()),
                                      packEvents(block.events)}));
  block.changed = false;
}

void SqliteInputOrder::flush() const {
  for (auto& [session, block] : open_) save(session, block);
}

void SqliteInputOrder::forEach(const SessionId& session, const std::function<void(const InputEvent&)>& take) const {
  flush();
  InputBlockRow row;
  tables_.forEach(declaredTable<InputBlockRow>(), session, AnyRow(row), [&] {
    for (const InputEvent& event : unpackEventBlock(row, tables_.connection())) take(event);
  });
}

}  // namespace urban_nav_store
