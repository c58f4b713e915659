// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/bag_records.hpp"

#include <algorithm>
#include <cstring>

#include "recording/storage/byte_reader.hpp"

namespace urban_nav_input::rosbag1 {

ByteView findField(ByteView fields, std::string_view name) {
  ByteReader reader(fields);
  while (reader.left() > 0) {
    const ByteView field = reader.bytes(reader.number<std::uint32_t>());
    if (!reader.isGood()) break;
    const bool is_meant = field.size > name.size() && std::memcmp(field.data, name.data(), name.size()) == 0 &&
                          field.data[name.size()] == '=';
    if (is_meant) return {field.data + name.size() + 1, field.size - name.size() - 1};
  }
  return {};
}

template <typename T>
std::optional<T> findNumber(ByteView fields, std::string_view name) {
  const ByteView field = findField(fields, name);
  if (field.data == nullptr || field.size != sizeof(T)) return std::nullopt;
  return ByteReader(field).number<T>();
}
template std::optional<std::uint8_t> findNumber(ByteView fields, std::string_view name);
template std::optional<std::uint32_t> findNumber(ByteView fields, std::string_view name);
template std::optional<std::uint64_t> findNumber(ByteView fields, std::string_view name);

std::string findText(ByteView fields, std::string_view name) {
  const ByteView field = findField(fields, name);
  return field.size == 0 ? std::string() : std::string(reinterpret_cast<const char*>(field.data), field.size);
}

std::optional<Record> RecordWalk::readHead() const {
  if (at_ >= bytes_.size) return std::nullopt;
  ByteReader reader({bytes_.data + at_, bytes_.size - static_cast<std::size_t>(at_)});
  Record record;
  record.begin = at_;
  record.header = reader.bytes(reader.number<std::uint32_t>());
  record.data_size = reader.number<std::uint32_t>();
  if (!reader.isGood()) return std::nullopt;
  const std::optional<std::uint8_t> op = findNumber<std::uint8_t>(record.header, "op");
  if (!op || *op < static_cast<std::uint8_t>(Op::Message) || *op > static_cast<std::uint8_t>(Op::Connection))
    return std::nullopt;
  record.op = static_cast<Op>(*op);
  record.data = reader.bytes(std::min<std::size_t>(record.data_size, reader.left()));
  return record;
}

std::optional<Record> RecordWalk::next() {
  const std::optional<Record> record = readHead();
  if (!record || record->data.size < record->data_size) return std::nullopt;
  at_ = static_cast<std::uint64_t>(record->data.data - bytes_.data) + record->data_size;
  return record;
}

std::optional<Record> RecordWalk::cutRecord() const {
  std::optional<Record> record = readHead();
  return record && record->data.size < record->data_size ? record : std::nullopt;
}

}  // namespace urban_nav_input::rosbag1
