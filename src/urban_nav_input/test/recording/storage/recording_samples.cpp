// SPDX-License-Identifier: BSD-3-Clause
#include "recording_samples.hpp"

#include <lz4frame.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MagneticField.h>
#include <sqlite3.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <zstd.h>

#include <stdexcept>

#include "recording/storage/byte_writer.hpp"
#include "recording/storage/crc32.hpp"
#include "recording/storage/inflate.hpp"
#include "recording/storage/mcap_records.hpp"
#include "urban_nav_input/recording/message_definition.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input::testing {

using mcap::Op;

namespace {

std_msgs::Header makeHeader(int i, const std::string& frame) {
  std_msgs::Header header;
  header.seq = static_cast<std::uint32_t>(i);
  header.stamp = ros::Time(100.0 + 0.1 * i);
  header.frame_id = frame;
  return header;
}

template <typename Message>
std::vector<std::uint8_t> serialize(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <typename Message>
std::vector<std::uint8_t> withoutSequenceNumber(const boost::shared_ptr<Message>& message) {
  message->header.seq = 0;
  return serialize(*message);
}

/// Returns the serialization of a message of one of some types; empty if it is of another.
template <typename... Messages>
std::vector<std::uint8_t> decodeAny(const RecordedMessage& recorded) {
  std::vector<std::uint8_t> bytes;
  const auto decode = [&](const auto& message) {
    if (message) bytes = withoutSequenceNumber(message);
  };
  (decode(recorded.as<Messages>()), ...);
  return bytes;
}

ByteView toView(const std::string& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

std::string compressed(const std::string& records, const std::string& compression) {
  if (compression.empty()) return records;
  std::string packed;
  if (compression == "zstd") {
    packed.resize(ZSTD_compressBound(records.size()));
    packed.resize(ZSTD_compress(packed.data(), packed.size(), records.data(), records.size(), 1));
  } else {
    packed.resize(LZ4F_compressFrameBound(records.size(), nullptr));
    packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), records.data(), records.size(), nullptr));
  }
  return packed;
}

void appendRecord(ByteWriter& out, Op op, const std::string& content) {
  out.number(static_cast<std::uint8_t>(op)).number(static_cast<std::uint64_t>(content.size())).bytes(content);
}

std::string toText(ByteView view) { return {reinterpret_cast<const char*>(view.data), view.size}; }

/// Rewrites an MCAP file record by record.
class McapRewriter {
 public:
  explicit McapRewriter(McapForm form) : form_(std::move(form)) {}

  std::string run(const std::string& mcap) {
    out_.bytes(std::string(mcap::kMagic));
    mcap::RecordWalk walk(toView(mcap), mcap::kMagic.size());
    while (const std::optional<mcap::Record> record = walk.next()) {
      if (record->op == Op::DataEnd) break;
      if (record->op == Op::Chunk) addChunk(*mcap::parseChunk(record->content));
      else if (record->op == Op::Header) appendRecord(out_, record->op, toText(record->content));
    }
    if (!form_.has_summary) return out_.str();  // as of a recorder that was killed
    ByteWriter end;
    end.number(std::uint32_t{0});
    appendRecord(out_, Op::DataEnd, end.str());
    const std::uint64_t begin = out_.size();
    out_.bytes(declarations_.str());
    ByteWriter statistics;
    statistics.number(messages_).number(schemas_).number(channels_).number(std::uint32_t{0}).number(std::uint32_t{0});
    statistics.number(chunks_).number(std::uint64_t{0}).number(std::uint64_t{0}).text("");
    appendRecord(out_, Op::Statistics, statistics.str());
    out_.bytes(chunk_indexes_.str());
    ByteWriter footer;
    footer.number(begin).number(std::uint64_t{0}).number(std::uint32_t{0});
    appendRecord(out_, Op::Footer, footer.str());
    out_.bytes(std::string(mcap::kMagic));
    return out_.str();
  }

 private:
  void addChunk(const mcap::Chunk& chunk) {
    const Inflated inflated = inflate(chunk.compression, chunk.packed, static_cast<std::size_t>(chunk.size));
    ByteWriter records;
    std::map<std::uint16_t, ByteWriter> indexes;
    mcap::RecordWalk walk(inflated.bytes());
    while (const std::optional<mcap::Record> record = walk.next()) {
      if (record->op == Op::Message) {
        ++messages_;
        const mcap::Message message = *mcap::parseMessage(record->content);
        indexes[message.channel].number(message.log_time).number(static_cast<std::uint64_t>(records.size()));
      } else {
        appendRecord(declarations_, record->op, toText(record->content));
        if (record->op == Op::Schema) ++schemas_;
        else ++channels_;
      }
      appendRecord(form_.is_chunked ? records : out_, record->op, toText(record->content));
    }
    if (!form_.is_chunked) return;
    ++chunks_;
    const std::string packed = compressed(records.str(), form_.compression);
    ByteWriter content, index, places;
    content.number(chunk.start).number(chunk.end).number(static_cast<std::uint64_t>(records.size()));
    content.number(crc32(records.view())).text(form_.compression);
    content.number(static_cast<std::uint64_t>(packed.size())).bytes(packed);
    index.number(chunk.start).number(chunk.end).number(static_cast<std::uint64_t>(out_.size()));
    index.number(static_cast<std::uint64_t>(mcap::kRecordHead + content.size()));
    appendRecord(out_, Op::Chunk, content.str());
    if (form_.has_indexes)
      for (const auto& [channel, entries] : indexes) {
        places.number(channel).number(static_cast<std::uint64_t>(out_.size()));
        ByteWriter record;
        record.number(channel).text(entries.str());
        appendRecord(out_, Op::MessageIndex, record.str());
      }
    index.text(places.str()).number(std::uint64_t{0}).text(form_.compression);
    index.number(static_cast<std::uint64_t>(packed.size())).number(static_cast<std::uint64_t>(records.size()));
    appendRecord(chunk_indexes_, Op::ChunkIndex, index.str());
  }

  McapForm form_;
  ByteWriter out_, declarations_, chunk_indexes_;
  std::uint64_t messages_ = 0;
  std::uint16_t schemas_ = 0;
  std::uint32_t channels_ = 0, chunks_ = 0;
};

/// Database that is written.
class Database {
 public:
  explicit Database(const std::string& path) { sqlite3_open(path.c_str(), &database_); }
  ~Database() { sqlite3_close(database_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// `values` are bound as integers if they are numbers, otherwise as bytes or text.
  void run(const std::string& sql, const std::vector<std::int64_t>& numbers = {},
           const std::vector<std::string>& texts = {}, bool is_blob = false) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database_, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK)
      throw std::runtime_error(sqlite3_errmsg(database_));
    int place = 0;
    for (const std::int64_t number : numbers) sqlite3_bind_int64(statement, ++place, number);
    for (const std::string& text : texts) {
      if (is_blob) sqlite3_bind_blob(statement, ++place, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
      else sqlite3_bind_text(statement, ++place, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    }
    sqlite3_step(statement);
    if (sqlite3_finalize(statement) != SQLITE_OK) throw std::runtime_error(sqlite3_errmsg(database_));
  }

 private:
  sqlite3* database_ = nullptr;
};

}  // namespace

void writeSampleBag(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.resize(1);
  transforms.transforms[0].header = makeHeader(0, "base_link");
  transforms.transforms[0].child_frame_id = "imu";
  transforms.transforms[0].transform.rotation.w = 1.0;
  bag.write("/tf_static", ros::Time(100.0), transforms);
  for (int i = 0; i < kSamples; ++i) {
    const ros::Time receipt(100.0 + 0.1 * i);
    sensor_msgs::Image image;
    image.header = makeHeader(i, "camera");
    image.height = 60;
    image.width = image.step = 80;
    image.encoding = "mono8";
    for (std::uint32_t k = 0; k < image.height * image.width; ++k)
      image.data.push_back(static_cast<std::uint8_t>(k * k * static_cast<std::uint32_t>(i + 1) >> 3U));
    bag.write("/camera/image_raw", receipt, image);
    sensor_msgs::Imu imu;
    imu.header = makeHeader(i, "imu");
    imu.angular_velocity.z = 0.01 * i;
    bag.write("/imu", receipt, imu);
    std_msgs::String text;
    text.data = "message " + std::to_string(i);
    bag.write("/text", receipt + ros::Duration(0.05), text);
  }
}

Contents readContents(const std::string& path) {
  Recording recording(path);
  Contents contents;
  MessageSelection selection = recording.select(std::nullopt);
  while (const std::optional<RecordedMessage> each = selection.next()) {
    std::vector<std::uint8_t> bytes =
        decodeAny<sensor_msgs::Image, sensor_msgs::Imu, sensor_msgs::MagneticField, sensor_msgs::CameraInfo,
                  sensor_msgs::CompressedImage, sensor_msgs::LaserScan>(*each);
    if (const auto text = each->as<std_msgs::String>()) {
      bytes = serialize(*text);
    } else if (const auto transforms = each->as<tf2_msgs::TFMessage>()) {
      for (geometry_msgs::TransformStamped& transform : transforms->transforms) transform.header.seq = 0;
      bytes = serialize(*transforms);
    }
    if (!bytes.empty()) contents[each->topic()].emplace_back(each->receipt(), std::move(bytes));
  }
  return contents;
}

std::string rewriteMcap(const std::string& mcap, const McapForm& form) { return McapRewriter(form).run(mcap); }

std::size_t countChunks(const std::string& mcap) {
  std::size_t chunks = 0;
  mcap::RecordWalk walk(toView(mcap), mcap::kMagic.size());
  while (const std::optional<mcap::Record> record = walk.next()) chunks += record->op == Op::Chunk ? 1 : 0;
  return chunks;
}

void writeDb3(const std::string& mcap_path, const std::string& path, int schema, bool is_packed) {
  Recording recording(mcap_path);
  Database database(path);
  database.run(
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
  database.run(
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
      "data BLOB NOT NULL)");
  database.run("CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL)");
  database.run("INSERT INTO schema VALUES(?, 'test')", {schema});
  if (schema >= 4)
    database.run(
        "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT "
        "NULL, encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL)");
  std::map<std::string, std::int64_t> ids;
  for (const Connection& connection : recording.connections()) {
    const auto id = static_cast<std::int64_t>(ids.size() + 1);
    ids[connection.topic] = id;
    database.run("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')", {id},
                 {connection.topic, toRos2Type(connection.type)});
    if (schema >= 4)
      database.run("INSERT INTO message_definitions VALUES(?, ?, 'ros2msg', ?, '')", {id},
                   {toRos2Type(connection.type), connection.definition});
  }
  MessageSelection selection = recording.select(std::nullopt);
  std::int64_t row = 0;
  while (const std::optional<RecordedMessage> message = selection.next()) {
    const std::string bytes = toText(message->bytes());
    database.run("INSERT INTO messages VALUES(?, ?, ?, ?)", {++row, ids[message->topic()], message->receipt()},
                 {is_packed ? compressed(bytes, "zstd") : bytes}, true);
  }
}

}  // namespace urban_nav_input::testing
