// SPDX-License-Identifier: BSD-3-Clause
#include "convert/recording.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/recording/recording_writer.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::DataError;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_input::Connection;
using urban_nav_input::RecordedMessage;

namespace {

constexpr double kMegabyte = 1e6;  // bytes

/// The files of a conversion, one after another.
class OutputFiles {
 public:
  OutputFiles(std::string path, const std::optional<double>& split) : path_(std::move(path)), split_(split) { begin(); }

  std::optional<std::string> refusal(const Connection& connection) { return writer_->refusal(connection); }

  void write(const RecordedMessage& message, urban_nav_input::ByteView bytes) {
    if (split_ && holds_messages_ && static_cast<double>(writer_->size()) >= kMegabyte * *split_) {
      writer_->commit();
      begin();
    }
    writer_->write(message.connection(), message.receipt(), bytes);
    holds_messages_ = true;
  }

  std::vector<std::string> commit() {
    writer_->commit();
    return paths_;
  }

 private:
  void begin() {
    const fs::path path(path_);
    paths_.push_back(split_ ? (path.parent_path() /
                               (path.stem().string() + "_" + std::to_string(paths_.size()) + path.extension().string()))
                                  .string()
                            : path_);
    writer_ = urban_nav_input::createRecording(paths_.back());
    holds_messages_ = false;
  }

  const std::string path_;
  const std::optional<double> split_;
  std::vector<std::string> paths_;
  std::unique_ptr<urban_nav_input::RecordingWriter> writer_;
  bool holds_messages_ = false;
};

void checkTopics(const urban_nav_input::Recording& recording, const std::string& input,
                 const std::vector<std::string>& topics) {
  const std::map<std::string, std::string> present = recording.topicTypes();
  for (const std::string& topic : topics) {
    if (present.count(topic) > 0) continue;
    std::string names;
    for (const auto& [name, type] : present) names += (names.empty() ? "" : ", ") + name;
    throw UserError("--topics " + topic, "is not a topic of " + input, names);
  }
}

urban_nav_input::ReceiptRange findRange(urban_nav_input::Recording& recording, const RecordingPart& part) {
  const auto after = [first = recording.begin()](const std::optional<double>& seconds) {
    return seconds ? first + static_cast<StampNs>(1e9 * *seconds) : 0;
  };
  return {after(part.from), after(part.to)};
}

/// Omitted messages, by topic.
class LeftOut {
 public:
  void add(const std::string& topic, const std::string& reason) { ++counts_[{topic, reason}]; }
  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    for (const auto& [key, count] : counts_)
      notes.push_back(key.first + ": " + std::to_string(count) + (count == 1 ? " message" : " messages") +
                      " left out: " + key.second);
    return notes;
  }

 private:
  std::map<std::pair<std::string, std::string>, std::int64_t> counts_;
};

}  // namespace

Converted convertRecording(const std::string& input, const std::string& output, const RecordingPart& part,
                           Console& console) {
  std::error_code error;
  if (fs::equivalent(input, output, error)) throw UserError(output, "is also the input", "another file");
  urban_nav_input::Recording recording(input);
  checkTopics(recording, input, part.topics);
  OutputFiles files(output, part.split);
  const auto topics = part.topics.empty() ? std::nullopt : std::optional<std::vector<std::string>>(part.topics);
  urban_nav_input::MessageSelection selection = recording.select(topics, findRange(recording, part));
  Progress progress(console, "convert", "messages", static_cast<std::int64_t>(selection.size()));
  Converted converted;
  LeftOut left_out;
  std::int64_t done = 0;
  while (const std::optional<RecordedMessage> message = selection.next()) {
    progress.update(++done);
    if (const std::optional<std::string> refusal = files.refusal(message->connection())) {
      left_out.add(message->topic(), *refusal);
      continue;
    }
    const urban_nav_input::ByteView bytes = message->bytes();
    if (bytes.data == nullptr) continue;  // in recording.warnings()
    try {
      files.write(*message, bytes);
      ++converted.counts[message->topic()];
    } catch (const urban_nav_core::Error&) {
      throw;
    } catch (const std::runtime_error& damage) {
      left_out.add(message->topic(), damage.what());
    }
  }
  converted.notes = left_out.notes();
  for (const std::string& warning : recording.warnings()) converted.notes.push_back(warning);
  if (converted.counts.empty() && selection.size() > 0)
    throw DataError(input, "holds no message that can be written to " + output + ": " + converted.notes.front(), "");
  converted.files = files.commit();
  progress.finish(done);
  return converted;
}

}  // namespace urban_nav
