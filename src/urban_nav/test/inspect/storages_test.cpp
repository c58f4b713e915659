// SPDX-License-Identifier: BSD-3-Clause
// One session in every storage and compression: the same results of info, doctor and places query.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands/stages.hpp"
#include "inspect/inspect.hpp"
#include "topics/places/places.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

namespace fs = std::filesystem;
using urban_nav_input::testing::readFile;

int callInspect(const std::vector<std::string>& words) {
  std::vector<const char*> argv = {"urban_nav"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  return runCommandLine({infoCommand(), doctorCommand(), placesCommand()}, addStageTables,
                        static_cast<int>(argv.size()), argv.data());
}

/// Returns text without what names the file.
std::string withoutName(std::string text, const std::string& path) {
  for (std::size_t at = 0; (at = text.find(path, at)) != std::string::npos;) text.erase(at, path.size());
  return text;
}

class StoragesOfASession : public ::testing::Test {
 protected:
  /// Returns results without the names of the input and of its kind.
  std::vector<std::string> results(const std::string& path) {
    const std::string info = folder_.file("info.json"), doctor = folder_.file("doctor.json"),
                      closures = folder_.file("closures.csv");
    EXPECT_EQ(callInspect({"info", path, "--json", info}), 0) << path;
    EXPECT_LE(callInspect({"doctor", path, "--json", doctor}), 1) << path;
    EXPECT_EQ(callInspect({"places", "query", "default", path, "-o", closures, "--threads", "1"}), 0) << path;
    nlohmann::json contents = nlohmann::json::parse(readFile(info)), found = nlohmann::json::parse(readFile(doctor));
    std::string rows = readFile(closures);
    for (nlohmann::json& entry : contents) entry.erase("name"), entry.erase("kind");
    for (nlohmann::json& entry : found["sessions"]) entry.erase("name"), entry.erase("kind");
    for (nlohmann::json& entry : found["findings"]) entry.erase("session"), entry.erase("name");
    const std::string name = fs::is_directory(path) ? fs::path(path).filename() : fs::path(path).stem();
    for (std::size_t at = 0; (at = rows.find(name + ",", at)) != std::string::npos;) rows.erase(at, name.size());
    return {withoutName(contents.dump(1), path), withoutName(found.dump(1), path), rows};
  }

  const urban_nav_input::testing::TemporaryFolder folder_;
};

TEST_F(StoragesOfASession, GiveTheSameResults) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  const std::string archive = data == nullptr ? std::string() : std::string(data) + "/recordings/session.tar.xz";
  if (!fs::exists(archive)) GTEST_SKIP() << "URBAN_NAV_DATA has no recordings/session.tar.xz";
  const std::string unpack = "tar -xf '" + archive + "' -C '" + folder_.file("") + "'";
  ASSERT_EQ(std::system(unpack.c_str()), 0);
  const std::vector<std::string> of_bag = results(folder_.file("session/session.bag"));
  EXPECT_NE(of_bag[0].find("sensor_msgs/Image"), std::string::npos);
  for (const char* form :
       {"none.mcap", "zstd.mcap", "lz4.mcap", "ros1.mcap", "apart.mcap", "sqlite", "sqlite/sqlite_0.db3", "files"}) {
    const std::vector<std::string> others = results(folder_.file("session") + "/" + form);
    for (std::size_t i = 0; i < of_bag.size(); ++i) EXPECT_EQ(others[i], of_bag[i]) << form;
  }
}

}  // namespace
}  // namespace urban_nav
