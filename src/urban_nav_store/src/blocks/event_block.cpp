// SPDX-License-Identifier: BSD-3-Clause
#include "blocks/event_block.hpp"

#include <map>

#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {

namespace {
constexpr std::size_t kMostEventBytes = std::size_t{1} << 26;
constexpr std::size_t kEvent = 12;  // bytes before compression
}  // namespace

std::string packEvents(const std::vector<InputEvent>& events) {
  std::map<std::string, std::uint32_t> places;
  for (const InputEvent& event : events) places[event.stream] = 0;
  std::string bytes;
  appendInteger32(bytes, static_cast<std::uint32_t>(places.size()));
  std::uint32_t next = 0;
  for (auto& [stream, place] : places) {
    place = next++;
    appendText(bytes, stream);
  }
  appendInteger32(bytes, static_cast<std::uint32_t>(events.size()));
  for (const InputEvent& event : events) appendInteger32(bytes, places.at(event.stream) << 1U | (event.used ? 1U : 0U));
  std::uint64_t last = 0;
  for (const InputEvent& event : events) {
    appendInteger(bytes, static_cast<std::uint64_t>(event.stamp) - last);
    last = static_cast<std::uint64_t>(event.stamp);
  }
  return deflated(bytes);
}

std::optional<std::vector<InputEvent>> unpackEvents(std::string_view packed) {
  const std::optional<std::string> bytes = inflated(packed, kMostEventBytes);
  if (!bytes) return std::nullopt;
  ByteReader reader(*bytes);
  const std::size_t named = reader.integer32();
  if (!reader.ok() || named > reader.left()) return std::nullopt;
  std::vector<std::string> streams(named);
  for (std::string& stream : streams) stream = reader.text();
  const std::size_t count = reader.integer32();
  if (!reader.ok() || count * kEvent > reader.left()) return std::nullopt;
  std::vector<InputEvent> events(count);
  for (InputEvent& event : events) {
    const std::uint32_t code = reader.integer32();
    if (!reader.ok() || (code >> 1U) >= streams.size()) return std::nullopt;
    event.stream = streams[code >> 1U];
    event.used = (code & 1U) != 0;
  }
  std::uint64_t last = 0;
  for (InputEvent& event : events) event.stamp = static_cast<std::int64_t>(last += reader.integer());
  if (!reader.complete()) return std::nullopt;
  return events;
}

}  // namespace urban_nav_store
