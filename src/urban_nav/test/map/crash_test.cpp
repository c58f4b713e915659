// SPDX-License-Identifier: BSD-3-Clause
// kill -9 of the whole command at random moments: `info` opens the store each time, and the run started again ends with
// the bytes of one that was never cut off.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "inspect/store_info.hpp"
#include "support/child.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

namespace fs = std::filesystem;
using testing::Child;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;

class Killed : public ::testing::Test {
 protected:
  void makeInputs(const std::vector<int>& frames_of_each) {
    for (const int frames : frames_of_each) {
      urban_nav_input::testing::KittiStyle style;
      style.frames = frames;
      inputs.push_back(folder.file("in" + std::to_string(frames)));
      urban_nav_input::testing::makeKittiFolder(inputs.back(), style);
    }
  }
  std::vector<std::string> words(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {"map", "--stages", "vo", "--threads", "1", "--out", out};
    all.insert(all.end(), inputs.begin(), inputs.end());
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::optional<int> run(const std::vector<std::string>& all, double seconds = 1e9) {
    Child command(all, folder.file("log"));
    const std::optional<int> status = command.endWithin(seconds);
    used = command.secondsUsed();
    return status;
  }
  std::string log() const { return readFile(folder.file("log")); }
  void expectSame(const std::string& a, const std::string& b) const {
    int files = 0;
    for (const auto& entry : fs::directory_iterator(a)) {
      const std::string name = entry.path().filename().string();
      if (name == "stats.csv" || name == "summary.json" || name == "report.html" || name == "session.db") continue;
      EXPECT_EQ(readFile(entry.path().string()), readFile(b + "/" + name)) << name;
      ++files;
    }
    EXPECT_GE(files, 18) << "six files of three sessions";
  }

  const TemporaryFolder folder;
  std::vector<std::string> inputs;
  double used = 0.0;  // by the last run, s
};

TEST_F(Killed, EndsWithTheBytesOfAnUnbrokenRun) {
  makeInputs({60, 25, 50});
  const std::string whole = folder.file("whole"), cut = folder.file("cut");
  ASSERT_EQ(run(words(whole)), 0) << log();
  double took = used;  // at first also what a cold disk costs
  std::mt19937 random(1);
  int kills = 0, resumed = 0;
  for (int round = 0; round < 3 || (round < 12 && (kills < 4 || resumed == 0)); ++round) {
    fs::remove_all(cut);
    std::optional<int> status;
    std::int64_t nodes = 0;
    for (double patience = 0.2 * took; !status; patience += 0.1 * took) {  // so that it comes to its end at last
      status = run(words(cut), patience + 0.4 * took * std::uniform_real_distribution<double>()(random));
      if (log().find("resuming an interrupted run") != std::string::npos) ++resumed;
      if (status) break;
      ++kills;
      if (!fs::exists(cut + "/session.db")) continue;
      const StoreInfo info = readStoreInfo(cut + "/session.db");
      std::int64_t now = 0;
      bool ended = info.sessions.size() == inputs.size();  // killed on its way out: nothing is left to go on from
      for (const StoredSession& session : info.sessions) {
        if (session.session.complete) now += session.nodes;
        ended = ended && session.session.complete && !session.resumable;
      }
      EXPECT_GE(now, nodes) << "a session that was complete is complete" << log();
      nodes = ended ? 0 : now;
    }
    EXPECT_EQ(status, 0) << log();
    took = std::min(took, used);
    expectSame(whole, cut);
    const StoreInfo a = readStoreInfo(whole + "/session.db"), b = readStoreInfo(cut + "/session.db");
    ASSERT_EQ(a.sessions.size(), 3U);
    ASSERT_EQ(b.sessions.size(), 3U);
    for (std::size_t i = 0; i < a.sessions.size(); ++i) {
      EXPECT_EQ(a.sessions[i].session, b.sessions[i].session);
      EXPECT_EQ(a.sessions[i].nodes, b.sessions[i].nodes);
      EXPECT_FALSE(b.sessions[i].resumable) << "a run that has ended leaves no states";
    }
  }
  EXPECT_GT(kills, 3);
  EXPECT_GT(resumed, 0) << "else the test says nothing";
}

TEST_F(Killed, RestartsIfTheResultWouldDiffer) {
  makeInputs({8, 10, 9});
  const std::string out = folder.file("out");
  // As if it was killed when all was done but the report: the last thing that is written, into a folder that cannot be
  // replaced.
  fs::create_directories(out + "/summary.json/in the way");
  const auto interrupted = [&] { ASSERT_EQ(run(words(out)), 2) << log(); };
  interrupted();
  interrupted();
  EXPECT_NE(log().find("3 of 3 sessions complete"), std::string::npos) << log();
  run(words(out, {"--set", "swf_vo.window=7"}));
  EXPECT_NE(log().find("with other parameters: starting from the beginning"), std::string::npos) << log();
  interrupted();
  EXPECT_NE(log().find("with other parameters: starting from the beginning"), std::string::npos) << log();
  run(words(out, {"--set", "memory_mb=1000"}));
  EXPECT_NE(log().find("3 of 3 sessions complete"), std::string::npos) << "no result depends on it" << log();
  fs::last_write_time(inputs[1] + "/image_0/000005.png", fs::file_time_type::clock::now());
  interrupted();
  EXPECT_NE(log().find("2 of 3 sessions complete"), std::string::npos) << log();
  urban_nav_input::testing::writeFile(inputs[0] + "/poses.txt", "scrambled");
  interrupted();
  EXPECT_NE(log().find("3 of 3 sessions complete"), std::string::npos) << "the truth is no input" << log();
  fs::remove_all(out + "/summary.json");
  ASSERT_EQ(run(words(out)), 0) << log();
  ASSERT_EQ(run(words(out)), 0) << log();
  EXPECT_EQ(log().find("earlier run"), std::string::npos) << "it had ended: " << log();
}

}  // namespace
}  // namespace urban_nav
