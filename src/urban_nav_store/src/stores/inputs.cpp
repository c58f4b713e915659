// SPDX-License-Identifier: BSD-3-Clause
#include "stores/inputs.hpp"

#include "blocks/event_block.hpp"
#include "schema/row.hpp"

namespace urban_nav_store {

namespace {

constexpr std::size_t kEvents = 4096;  // in a block: some ten seconds of all sensors

std::vector<InputEvent> readBlock(RowReader& reader, std::int64_t& number) {
  reader.text();
  number = reader.integer();
  const std::int64_t count = reader.integer();
  std::optional<std::vector<InputEvent>> events = unpackEvents(reader.blob());
  if (!events || static_cast<std::int64_t>(events->size()) != count)
    reader.damaged("a block of input events cannot be unpacked");
  return std::move(*events);
}

}  // namespace

bool operator==(const InputEvent& a, const InputEvent& b) {
  return a.stream == b.stream && a.stamp == b.stamp && a.used == b.used;
}

void Inputs::append(const SessionId& session, const InputEvent& event) {
  connection_.beginWriting();
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

Inputs::Block Inputs::last(const SessionId& session) const {
  Block block;
  RowReader reader(connection_, schema::input(),
                   "WHERE session=?1 AND block=(SELECT max(block) FROM input WHERE session=?1)");
  reader.statement().bind(0, session);
  while (reader.next()) block.events = readBlock(reader, block.number);
  return block;
}

void Inputs::save(const SessionId& session, Block& block) const {
  if (!block.changed) return;
  const std::string bytes = packEvents(block.events);
  RowWriter(connection_, putSql(schema::input()))
      .text(session)
      .integer(block.number)
      .integer(static_cast<std::int64_t>(block.events.size()))
      .blob(bytes)
      .write();
  block.changed = false;
}

void Inputs::flush() const {
  for (auto& [session, block] : open_) save(session, block);
}

void Inputs::forEach(const SessionId& session, const std::function<void(const InputEvent&)>& take) const {
  flush();
  RowReader reader(connection_, schema::input(), "WHERE session=?");
  reader.statement().bind(0, session);
  while (reader.next()) {
    std::int64_t number = 0;
    for (const InputEvent& event : readBlock(reader, number)) take(event);
  }
  verifyTally(reader, session);
}

}  // namespace urban_nav_store
