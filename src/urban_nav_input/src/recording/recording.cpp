// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/recording.hpp"

#include <stdexcept>
#include <utility>

#include "recording/bag_contents.hpp"
#include "recording/recording_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/connection_definition.hpp"

namespace urban_nav_input {

RecordedMessages::RecordedMessages(std::list<MessageSelection> files) : files_(std::move(files)) {
  for (const MessageSelection& file : files_) size_ += file.size();
}

std::optional<RecordedMessage> RecordedMessages::next() {
  while (!files_.empty()) {
    if (std::optional<RecordedMessage> message = files_.front().next()) return message;
    files_.pop_front();
  }
  return std::nullopt;
}

Recording::Recording(const std::vector<std::string>& paths) : paths_(paths) {
  for (const std::string& path : paths_) files_.push_back(std::make_unique<RecordingFile>(path));
}

Recording::Recording(Recording&& other) noexcept = default;
Recording::~Recording() = default;

std::string Recording::kind() const { return files_.front()->storage().kind(); }

std::string Recording::description() const { return files_.front()->storage().description(); }

std::map<std::string, std::string> Recording::topicTypes() const {
  std::map<std::string, std::string> types;
  for (const auto& file : files_)
    for (const Connection& connection : file->storage().connections()) types[connection.topic] = connection.type;
  return types;
}

std::vector<Connection> Recording::connections() const {
  std::vector<Connection> all;
  for (const auto& file : files_) {
    const std::vector<Connection>& some = file->storage().connections();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::string Recording::undecoded(const std::string& topic, const std::string& type) {
  MessageSelection selection = select(std::vector<std::string>{topic});
  std::optional<RecordedMessage> first = selection.next();
  while (first && !type.empty() && first->connection().type != type) first = selection.next();
  if (!first) return {};
  const Connection& connection = first->connection();
  if (connection.encoding != "ros1" && connection.encoding != "cdr")
    return "its messages are encoded as " + (connection.encoding.empty() ? "nothing" : connection.encoding);
  try {
    findDefinition(connection);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  const ByteView bytes = first->bytes();
  if (bytes.data == nullptr) return "the first of its messages is damaged";
  if (connection.encoding == "cdr" && !cdrEncoding(bytes))
    return "its messages have an unsupported form of CDR (XCDR2 or parameter lists)";
  return {};
}

std::size_t Recording::count(const std::string& topic) { return select(std::vector<std::string>{topic}).size(); }

urban_nav_ros::StaticTransforms Recording::transforms() { return readTransforms(*this); }

urban_nav_core::StampNs Recording::begin() { return select(std::nullopt).first(); }

urban_nav_core::StampNs Recording::end() { return select(std::nullopt).last(); }

RecordedMessages Recording::messages(const std::vector<std::string>& topics, const ReceiptRange& range) {
  std::list<MessageSelection> selections;
  for (RecordingFile* file : files()) selections.emplace_back(std::vector<RecordingFile*>{file}, topics, range);
  return RecordedMessages(std::move(selections));
}

MessageSelection Recording::select(const std::optional<std::vector<std::string>>& topics, const ReceiptRange& range) {
  return {files(), topics, range};
}

std::vector<std::string> Recording::warnings() const {
  std::vector<std::string> all;
  for (const auto& file : files_)
    for (const std::string& warning : file->storage().warnings()) all.push_back(file->path() + ": " + warning);
  return all;
}

std::vector<RecordingFile*> Recording::files() const {
  std::vector<RecordingFile*> files;
  for (const auto& file : files_) files.push_back(file.get());
  return files;
}

}  // namespace urban_nav_input
