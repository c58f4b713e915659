// SPDX-License-Identifier: BSD-3-Clause
// The server of `labels teach`: data of the page, corrections and their file, refusals, and the command itself.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "support/child.hpp"
#include "support/taught_yard.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "view/teach/served_scene.hpp"

namespace urban_nav {
namespace {

using testing::Child;
using testing::sendRequest;
using testing::ServedScene;
using urban_nav_core::UserError;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_input::testing::writeFile;

constexpr const char* kHostileScene = "<img src=x onerror=alert(1)>'\"&_points.csv";
constexpr const char* kVehicleOf2450 = R"({"action": "correct", "point": 2450, "class": "vehicle"})";

class TeachServer : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    testing::writeTaughtYard(*shared_, shared_->file("m"), shared_->file("yard_points.csv"));
    std::filesystem::copy_file(shared_->file("yard_points.csv"), shared_->file(kHostileScene));
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
  }
  static void TearDownTestSuite() { shared_.reset(); }

  std::string file() const { return folder_.file("c.ply"); }
  std::string log() const { return readFile(folder_.file("log")); }
  static nlohmann::json readState(const ServedScene& served) {
    return nlohmann::json::parse(served.get("/api/state").body);
  }
  /// Starts the command and returns port and token of the address that it prints.
  std::pair<int, std::string> readAddress(Child& command) const {
    const std::regex line("(^|\n)http://127\\.0\\.0\\.1:([0-9]+)/\\?token=([A-Za-z0-9_-]{16,})\n");
    std::smatch found;
    std::string text;
    for (int i = 0; i < 600 && !std::regex_search(text, found, line); ++i) {
      ::usleep(50'000);
      text = log();
    }
    if (!found.empty()) return {std::stoi(found[2]), found[3]};
    command.send(SIGKILL);
    return {0, ""};
  }
  std::optional<int> refused(std::vector<std::string> words) const {
    words.insert(words.begin(), {"labels", "teach"});
    return Child(words, folder_.file("log")).endWithin(60.0);
  }

  static inline std::unique_ptr<TemporaryFolder> shared_;
  const TemporaryFolder folder_;
  const std::string scene_ = shared_->file("yard_points.csv"), model_ = shared_->file("m");
};

TEST_F(TeachServer, ThePageHoldsEverythingButNames) {
  const ServedScene served(shared_->file(kHostileScene), model_, file());
  const testing::RawAnswer page = served.get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_NE(page.body.find("class-buttons"), std::string::npos);
  for (const char* words : {"onerror", "src=\"http", "href=\"http", "NONCE", "<!-- main -->", "<!-- scripts -->"})
    EXPECT_EQ(page.body.find(words), std::string::npos) << words;
  EXPECT_NE(std::string(readState(served)["scene"]).find(kHostileScene), std::string::npos) << "as data";
  EXPECT_EQ(sendRequest(served.port(), "GET", "/").status, 403);
  EXPECT_EQ(
      sendRequest(served.port(), "POST", "/api/correct", "Content-Type: application/json\r\n", kVehicleOf2450).status,
      403);
  for (const char* path : {"/api/edit", "/etc/passwd", "/api/tiles", "/teach.html"})
    EXPECT_EQ(served.get(path).status, 404) << path;
}

TEST_F(TeachServer, DescribesEachPoint) {
  const ServedScene served(scene_, model_, file());
  const nlohmann::json state = readState(served);
  const std::size_t points = state["counts"]["points"];
  EXPECT_EQ(points, 3900U);
  EXPECT_EQ(served.get("/api/cloud").body.size(), 16 * points) << "a place and a unit, no image";
  EXPECT_EQ(served.get("/api/answers").body.size(), 3 * points);
  EXPECT_EQ(served.get("/api/image").status, 204);
  EXPECT_TRUE(state["image"].is_null());
  EXPECT_EQ(state["classes"].size(), 7U) << "the model does not know kinds of wall";
  EXPECT_FALSE(state["suggestions"].empty());
  EXPECT_TRUE(state["corrections"].empty());
  EXPECT_FALSE(state["can_undo"]);
  EXPECT_FALSE(std::filesystem::exists(file())) << "nothing is written before the first correction";
}

TEST_F(TeachServer, ACorrectionIsInTheFileAtOnceAndThenInTheAnswers) {
  ServedScene served(scene_, model_, file());
  const std::string before = served.get("/api/answers").body;
  const int revision = readState(served)["revision"];
  ASSERT_EQ(served.post(R"({"action": "correct", "point": 2450, "radius": 2, "class": "vehicle"})").status, 200);
  EXPECT_NE(readFile(file()).find("correction 2450 2 vehicle"), std::string::npos);
  served.source().waitForAnswers();
  const nlohmann::json state = readState(served);
  EXPECT_GT(static_cast<int>(state["revision"]), revision) << "other pages load the answers";
  EXPECT_EQ(state["corrections"].size(), 1U);
  EXPECT_EQ(state["corrections"][0]["class"], "vehicle");
  const std::string after = served.get("/api/answers").body;
  EXPECT_EQ(after[3 * 2450], 7);
  EXPECT_EQ(after[3 * 2450 + 2], 2) << "corrected";
  int elsewhere = 0;  // the other car, which was not corrected
  for (std::size_t i = 2900; i < 3400; ++i) elsewhere += after[3 * i] == 7 && after[3 * i + 2] != 2 ? 1 : 0;
  EXPECT_GT(elsewhere, 250) << "the model has learnt";
  EXPECT_EQ(served.post(R"({"action": "undo"})").status, 200);
  served.source().waitForAnswers();
  EXPECT_TRUE(before == served.get("/api/answers").body);
  EXPECT_EQ(readFile(file()).find("correction 2450"), std::string::npos);
  EXPECT_EQ(served.post(R"({"action": "redo"})").status, 200);
  served.source().waitForAnswers();
  EXPECT_TRUE(after == served.get("/api/answers").body);
  const ServedScene again(scene_, model_, file());
  EXPECT_TRUE(after == again.get("/api/answers").body) << "a new server continues from the file";
}

TEST_F(TeachServer, RefusesOtherWords) {
  const ServedScene served(scene_, model_, file());
  for (const char* words :
       {"", "[]", "{}", R"({"action": "remove"})", R"({"action": "correct"})", R"({"action": "correct", "point": 1})",
        R"({"action": "correct", "point": -1, "class": "grass"})",
        R"({"action": "correct", "point": 1.5, "class": "grass"})",
        R"({"action": "correct", "point": 3900, "class": "grass"})",
        R"({"action": "correct", "point": 99999999999, "class": "grass"})",
        R"({"action": "correct", "point": 1, "class": "gras"})", R"({"action": "correct", "point": 1, "class": 2})",
        R"({"action": "correct", "point": 1, "class": "grass", "radius": -1})",
        R"({"action": "correct", "point": 1, "class": "grass", "radius": 1e9})",
        R"({"action": "correct", "point": 1, "class": "grass", "file": "x"})"})
    EXPECT_EQ(served.post(words).status, 400) << words;
  EXPECT_NE(served.post(R"({"action": "undo"})").body.find("\"changed\": false"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file()));
  const ServedScene reading(scene_, model_, file(), true);
  EXPECT_EQ(reading.post(kVehicleOf2450).status, 400);
  EXPECT_TRUE(readState(reading)["read_only"]);
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(TeachServer, DoesNotOverwriteTheWorkOfAnotherProgram) {
  const ServedScene first(scene_, model_, file()), second(scene_, model_, file());
  ASSERT_EQ(first.post(kVehicleOf2450).status, 200);
  const std::string bytes = readFile(file());
  const testing::RawAnswer refusal = second.post(R"({"action": "correct", "point": 3500, "class": "foliage"})");
  EXPECT_EQ(refusal.status, 409);
  EXPECT_NE(refusal.body.find("another program"), std::string::npos) << refusal.body;
  EXPECT_TRUE(bytes == readFile(file()));
  EXPECT_TRUE(readState(second)["corrections"].empty());
}

TEST_F(TeachServer, LosesNothingWhenItIsKilled) {
  {
    Child command({"labels", "teach", scene_, "--model", model_, "-o", file()}, folder_.file("log"));
    const auto [port, token] = readAddress(command);
    ASSERT_NE(port, 0) << log();
    const std::string head = "Content-Type: application/json\r\nX-Urban-Nav-Token: " + token + "\r\n";
    for (const char* words : {kVehicleOf2450, R"({"action": "correct", "point": 3500, "class": "foliage"})"})
      ASSERT_EQ(sendRequest(port, "POST", "/api/correct", head, words).status, 200);
    command.send(SIGKILL);
    command.endWithin(60.0);
  }
  const ServedScene again(scene_, model_, file());
  const nlohmann::json state = readState(again);
  ASSERT_EQ(state["corrections"].size(), 2U);
  EXPECT_EQ(state["corrections"][1]["class"], "foliage");
}

TEST_F(TeachServer, EndsWithASignal) {
  Child command({"labels", "teach", scene_, "--model", model_, "-o", file(), "--read-only"}, folder_.file("log"));
  const auto [port, token] = readAddress(command);
  ASSERT_NE(port, 0) << log();
  EXPECT_EQ(sendRequest(port, "GET", "/?token=" + token).status, 200);
  EXPECT_EQ(sendRequest(port, "GET", "/").status, 403);
  command.send(SIGTERM);
  EXPECT_EQ(command.endWithin(60.0), 0) << log();
}

TEST_F(TeachServer, TheCommandNamesWhatItCannotUse) {
  const auto expectRefused = [&](const std::vector<std::string>& words, const std::string& named, int status = 2) {
    EXPECT_EQ(refused(words), status) << named;
    EXPECT_NE(log().find(named), std::string::npos) << log();
  };
  writeFile(folder_.file("empty_points.csv"), "x,y,z\n");
  writeFile(folder_.file("nan_points.csv"), "x,y,z\nnan,nan,nan\n");
  writeFile(folder_.file("one_points.csv"), "x,y,z\n1,2,3\n");
  writeFile(folder_.file("day.bag"), "no bag\n");
  writeFile(folder_.file("x.ply"), "ply\n");
  expectRefused({folder_.file("absent.csv"), "--model", model_}, "absent.csv");
  expectRefused({folder_.file("day.bag"), "--model", model_}, "map.ply");
  expectRefused({folder_.file("empty_points.csv"), "--model", model_}, "empty_points.csv", 1);
  expectRefused({folder_.file("nan_points.csv"), "--model", model_}, "nan_points.csv", 1);
  expectRefused({shared_->file("."), "--model", model_}, "scenes");
  expectRefused({scene_, "--model", folder_.file("nothing")}, "nothing");
  expectRefused({scene_, "--model", scene_}, "yard_points.csv");
  expectRefused({scene_, "--model", model_, "-o", folder_.file("c.csv")}, "c.csv");
  expectRefused({scene_, "--model", model_, "-o", folder_.file("x.ply")}, "x.ply");
  expectRefused({scene_, "--model", model_, "-o", folder_.file("no/c.ply")}, "no");
  const HttpServer taken("127.0.0.1", 0);
  expectRefused({scene_, "--model", model_, "-o", file(), "--port", std::to_string(taken.port())},
                std::to_string(taken.port()));
  EXPECT_FALSE(std::filesystem::exists(file()));
}

}  // namespace
}  // namespace urban_nav
