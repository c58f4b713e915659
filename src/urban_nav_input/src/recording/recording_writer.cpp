// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/recording_writer.hpp"

#include <filesystem>
#include <map>
#include <stdexcept>
#include <utility>

#include "recording/message/ros1_form.hpp"
#include "recording/message/transcoder.hpp"
#include "recording/storage/bag_file_writer.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/connection_definition.hpp"
#include "urban_nav_input/recording/mcap_writer.hpp"

namespace urban_nav_input {

namespace {

class McapRecording : public RecordingWriter {
 public:
  explicit McapRecording(const std::string& path) : writer_(path) {}

  std::optional<std::string> refusal(const Connection&) override { return std::nullopt; }

  void write(const Connection& connection, urban_nav_core::StampNs receipt, ByteView message) override {
    Target& target = findTarget(connection);
    if (target.transcoder)
      message = target.transcoder->convert(message, MessageEncoding::Ros1, MessageEncoding::CdrLittleEndian);
    writer_.write(target.channel, receipt, message);
  }

  std::uint64_t size() const override { return writer_.size(); }
  void commit() override { writer_.commit(); }

 private:
  struct Target {
    std::uint16_t channel = 0;
    std::optional<Transcoder> transcoder;
  };

  Target& findTarget(const Connection& connection) {
    const auto [known, is_new] = targets_.try_emplace(&connection);
    Target& target = known->second;
    if (!is_new) return target;
    McapChannel channel{connection.topic,      toRos2Type(connection.type), connection.definition_encoding,
                        connection.definition, connection.encoding,         {}};
    if (!connection.caller_id.empty()) channel.metadata["callerid"] = connection.caller_id;
    if (connection.is_latched) channel.metadata["latching"] = "1";
    try {
      const bool is_ros1 = connection.encoding == "ros1";
      if (is_ros1 || (connection.encoding == "cdr" && connection.definition.empty())) {
        const MessageDefinition definition = findDefinition(connection);
        channel.schema_encoding = "ros2msg";
        channel.definition = printRos2(definition);
        channel.encoding = "cdr";
        if (is_ros1) target.transcoder.emplace(definition, withoutSequence(definition));
      }
    } catch (const std::invalid_argument&) {
      // The messages are copied unchanged.
    }
    target.channel = writer_.addChannel(channel);
    return target;
  }

  McapWriter writer_;
  std::map<const Connection*, Target> targets_;
};

class BagRecording : public RecordingWriter {
 public:
  explicit BagRecording(const std::string& path) : writer_(path) {}

  std::optional<std::string> refusal(const Connection& connection) override {
    try {
      findForm(connection);
      return std::nullopt;
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  }

  void write(const Connection& connection, urban_nav_core::StampNs receipt, ByteView message) override {
    Ros1Form& form = findForm(connection);
    writer_.write(form.connection(), receipt, form.convert(message));
  }

  std::uint64_t size() const override { return writer_.size(); }
  void commit() override { writer_.commit(); }

 private:
  /// Throws std::invalid_argument if the messages cannot be decoded.
  Ros1Form& findForm(const Connection& connection) {
    const auto known = forms_.find(&connection);
    return known != forms_.end() ? known->second : forms_.emplace(&connection, Ros1Form(connection)).first->second;
  }

  BagFileWriter writer_;
  std::map<const Connection*, Ros1Form> forms_;
};

}  // namespace

std::unique_ptr<RecordingWriter> createBag(const std::string& path) { return std::make_unique<BagRecording>(path); }

std::unique_ptr<RecordingWriter> createRecording(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".mcap") return std::make_unique<McapRecording>(path);
  if (ending == ".bag") return createBag(path);
  throw urban_nav_core::UserError(path, "has no file name extension of a recording format", ".bag, .mcap");
}

}  // namespace urban_nav_input
