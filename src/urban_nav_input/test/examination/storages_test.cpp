// SPDX-License-Identifier: BSD-3-Clause
// Results of info and doctor for the same messages in every storage.
#include <gtest/gtest.h>

#include <filesystem>
#include <tuple>

#include "recording/storage/recording_samples.hpp"
#include "urban_nav_input/examination/diagnosis.hpp"
#include "urban_nav_input/examination/input_info.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/recording/recording_writer.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

namespace fs = std::filesystem;
using testing::readFile;
using testing::writeFile;

std::string withoutPath(std::string text, const std::string& path) {
  for (std::size_t at = 0; (at = text.find(path, at)) != std::string::npos;) text.erase(at, path.size());
  return text;
}

/// Returns the result of `info` as text.
std::string infoText(const std::string& path) {
  const InputInfo info = lookInto(path);
  std::string text;
  for (const StreamInfo& stream : info.streams)
    for (const std::string& value :
         {stream.name, stream.type, std::to_string(stream.messages), std::to_string(stream.first),
          std::to_string(stream.last), std::to_string(stream.rate_hz), std::to_string(stream.longest_gap_s),
          std::to_string(stream.backward), stream.undecoded})
      text += value + "\n";
  for (const std::string& line : info.notes) text += line + "\n";
  for (const std::string& line : info.warnings) text += line + "\n";
  return withoutPath(text, path);
}

/// Returns the result of `doctor` as text.
std::string doctorText(const std::string& path) {
  std::string text;
  for (const InputSession& session : findSessions({path})) {
    const Diagnosis diagnosis = examine(session, {}, [](std::int64_t, std::int64_t) {});
    for (const std::string& line : diagnosis.contents) text += line + "\n";
    text += std::to_string(diagnosis.pairs) + " " + std::to_string(diagnosis.complete) + " " +
            std::to_string(diagnosis.duration_s) + " " + std::to_string(diagnosis.rate_hz) + "\n";
    for (const Finding& finding : diagnosis.findings)
      text += std::string(toString(finding.kind)) + ": " + finding.text + " -> " + finding.remedy + "\n";
  }
  return withoutPath(text, path);
}

TEST(Storages, InfoAndDoctorGiveTheSameResults) {
  const testing::TemporaryFolder folder;
  testing::writeSampleBag(folder.file("a.bag"));
  Recording recording(folder.file("a.bag"));
  const std::unique_ptr<RecordingWriter> writer = createRecording(folder.file("a.mcap"));
  MessageSelection selection = recording.select(std::nullopt);
  while (const std::optional<RecordedMessage> message = selection.next())
    writer->write(message->connection(), message->receipt(), message->bytes());
  writer->commit();
  std::vector<std::string> forms = {"a.mcap"};
  const std::string mcap = readFile(folder.file("a.mcap"));
  for (const auto& [name, form] : {std::pair<std::string, testing::McapForm>{"none", {"", true, true, true}},
                                   {"lz4", {"lz4", true, true, true}},
                                   {"no_index", {"zstd", true, false, true}},
                                   {"unchunked", {"", false, false, true}}}) {
    fs::create_directory(folder.file(name));
    forms.push_back(name + "/a.mcap");
    writeFile(folder.file(forms.back()), testing::rewriteMcap(mcap, form));
  }
  for (const int schema : {3, 4}) {
    fs::create_directory(folder.file(std::to_string(schema)));
    forms.push_back(std::to_string(schema) + "/a.db3");
    testing::writeDb3(folder.file("a.mcap"), folder.file(forms.back()), schema);
  }
  fs::create_directory(folder.file("a"));
  testing::writeDb3(folder.file("a.mcap"), folder.file("a/a_0.db3"), 4, true);
  writeFile(folder.file("a/metadata.yaml"),
            "rosbag2_bagfile_information:\n  version: 5\n  compression_format: zstd\n  compression_mode: MESSAGE\n"
            "  relative_file_paths:\n    - a_0.db3\n");
  forms.emplace_back("a");

  const std::string info = infoText(folder.file("a.bag")), doctor = doctorText(folder.file("a.bag"));
  EXPECT_NE(info.find("sensor_msgs/Imu\n" + std::to_string(testing::kSamples) + "\n"), std::string::npos) << info;
  EXPECT_NE(doctor.find(" -> "), std::string::npos) << doctor;
  for (const std::string& form : forms) {
    EXPECT_EQ(infoText(folder.file(form)), info) << form;
    EXPECT_EQ(doctorText(folder.file(form)), doctor) << form;
  }
}

}  // namespace
}  // namespace urban_nav_input
