// SPDX-License-Identifier: BSD-3-Clause
// A recording in several bags is one session, whether its bags are mapped at once, one after the other, or after a
// kill -9.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>

#include "base/parameters.hpp"
#include "commands/stages.hpp"
#include "convert/convert.hpp"
#include "inspect/store_info.hpp"
#include "map/bag_checkpoint.hpp"
#include "map/map_pipeline.hpp"
#include "map/store_keys.hpp"
#include "support/child.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/input_parameters.hpp"
#include "urban_nav_input/testing/bags.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_keyframe_place.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav {
namespace {

namespace fs = std::filesystem;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;

constexpr int kFrames = 60;
const std::vector<std::string> kSameWhenSplit = {"trajectory.tum",          "trajectory.kitti", "covariance.csv",
                                                 "relative_covariance.csv", "graph.g2o",        "landmarks.ply"};

/// Specific forces at the nodes, as the store has it.
std::string forcesIn(const std::string& store) {
  urban_nav_store::Store file(store, urban_nav_store::Access::Read);
  const auto sessions = file.sessions().all();
  return sessions.size() == 1 ? file.states().get(sessions.front().id, kForcesStage).value_or("none") : "several";
}

class Split : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    urban_nav_input::testing::KittiStyle style;
    style.frames = kFrames;
    urban_nav_input::testing::makeKittiFolder(shared_->file("in"), style);
    Console console;
    convertStereoFolder(shared_->file("in"), shared_->file("whole.bag"), {}, console);
    urban_nav_input::testing::splitBag(shared_->file("whole.bag"), {shared_->file("all.bag")});
    urban_nav_input::testing::splitBag(shared_->file("whole.bag"), parts());
    map(parts(), whole());
  }
  static void TearDownTestSuite() { shared_.reset(); }
  static std::string part(int i) { return shared_->file("part_" + std::to_string(i) + ".bag"); }
  static std::vector<std::string> parts() { return {part(0), part(1), part(2)}; }
  static std::string all() { return shared_->file("all.bag"); }
  static std::string whole() { return shared_->file("whole"); }

  static std::string map(const std::vector<std::string>& inputs, const std::string& out,
                         const std::string& store_of = {}, const std::function<void(MapOptions&)>& change = {}) {
    const Arguments none({}, addStageTables);
    MapOptions request{inputs, out, {"vo"}, "", "", "", {}, loadParameters(none), 1};
    if (!store_of.empty()) request.store = store_of + "/session.db";
    if (change) change(request);
    apply(request.parameters.get(urban_nav_input::inputTable()), request.source);
    Console console;
    ::testing::internal::CaptureStderr();
    runMap(request, makeStages(), console);
    return ::testing::internal::GetCapturedStderr();
  }
  static void expectWhole(const std::string& out) {
    for (const std::string& name : kSameWhenSplit)
      EXPECT_TRUE(readFile(whole() + "/" + name) == readFile(out + "/" + name)) << name;
    EXPECT_TRUE(forcesIn(whole() + "/session.db") == forcesIn(out + "/session.db"));
    const StoreInfo a = readStoreInfo(whole() + "/session.db"), b = readStoreInfo(out + "/session.db");
    ASSERT_EQ(b.sessions.size(), 1U);
    EXPECT_EQ(a.sessions[0].session, b.sessions[0].session);
    EXPECT_EQ(a.sessions[0].nodes, b.sessions[0].nodes);
    EXPECT_EQ(a.sessions[0].streams[0].messages, b.sessions[0].streams[0].messages);
    EXPECT_TRUE(b.sessions[0].next_bag);
    EXPECT_FALSE(b.sessions[0].resumable);
  }

  const TemporaryFolder folder;

 private:
  static std::unique_ptr<TemporaryFolder> shared_;
};
std::unique_ptr<TemporaryFolder> Split::shared_;

TEST_F(Split, IsOneRecording) {
  map({all()}, folder.file("all"));
  for (const std::string& name : kSameWhenSplit)
    EXPECT_TRUE(readFile(whole() + "/" + name) == readFile(folder.file("all/" + name))) << name;
  EXPECT_EQ(urban_nav_core::readTum(whole() + "/trajectory.tum").size(), static_cast<std::size_t>(kFrames));
  EXPECT_NE(forcesIn(whole() + "/session.db"), "none");
  EXPECT_TRUE(forcesIn(whole() + "/session.db") == forcesIn(folder.file("all/session.db")));
}

TEST_F(Split, GoesOnBagByBagInOneFolder) {
  const std::string out = folder.file("out");
  map({part(0)}, out);
  EXPECT_LT(urban_nav_core::readTum(out + "/trajectory.tum").size(), static_cast<std::size_t>(kFrames) / 2);
  const std::string said = map({part(1)}, out, out);
  EXPECT_NE(said.find("part_1.bag continues session part_0.bag, after 1 bag of it"), std::string::npos) << said;
  map({part(2)}, out, out);
  expectWhole(out);
  map({part(2)}, out, out);
  expectWhole(out);  // there is nothing after the end, and nothing to make again from
}

TEST_F(Split, GoesOnInAnotherFolder) {
  map({part(0)}, folder.file("first"));
  map({part(1), part(2)}, folder.file("rest"), folder.file("first"));
  expectWhole(folder.file("rest"));
  EXPECT_EQ(readStoreInfo(folder.file("first/session.db")).sessions[0].nodes,
            static_cast<std::int64_t>(urban_nav_core::readTum(folder.file("first/trajectory.tum")).size()))
      << "a store to go on from is only read";
  const std::string said =
      map(parts(), folder.file("all"), folder.file("first"), [](MapOptions& request) { request.threads = 2; });
  EXPECT_NE(said.find("continues session"), std::string::npos) << said;
  expectWhole(folder.file("all"));
}

/// Lines of a summary that state what odometry knows of the wheels.
std::vector<std::string> wheelStates(const std::string& summary) {
  const std::string text = readFile(summary);
  static const std::regex state("\"wheel_[a-z_]+\": [^,\n}]+");
  std::vector<std::string> lines;
  for (std::sregex_iterator match(text.begin(), text.end(), state), end; match != end; ++match)
    lines.push_back(match->str());
  return lines;
}

TEST_F(Split, GoesOnWithWheels) {
  const auto with_wheels = [](MapOptions& request) {
    request.parameters.set("input.motion_input=wheels");
    request.parameters.set("input.wheel_noise=0.05");
  };
  map(parts(), folder.file("once"), {}, with_wheels);
  for (int i = 0; i < 3; ++i) map({part(i)}, folder.file("out"), i > 0 ? folder.file("out") : "", with_wheels);
  EXPECT_TRUE(readFile(folder.file("once/covariance.csv")) == readFile(folder.file("out/covariance.csv")));
  const std::vector<std::string> once = wheelStates(folder.file("once/summary.json"));
  EXPECT_EQ(once.size(), 6U);
  EXPECT_EQ(wheelStates(folder.file("out/summary.json")), once);
}

/// Rows of place recognition: of panoramas, or of keyframes in addition.
template <typename Row>
std::vector<Row> placeRows(const std::string& store) {
  urban_nav_store::Store file(store, urban_nav_store::Access::Read);
  std::vector<Row> rows;
  for (const auto& session : file.sessions().all())
    urban_nav_store::TableStore<Row>(file).forEach(session.id, [&](const Row& row) { rows.push_back(row); });
  return rows;
}

TEST_F(Split, KeepsTheWordsOfKeyframesInAdditionToPanoramas) {
  const auto with_places = [](MapOptions& request) { request.stages = {"vo", "places"}; };
  map({all()}, folder.file("once"), {}, with_places);
  for (int i = 0; i < 3; ++i) map({part(i)}, folder.file("out"), i > 0 ? folder.file("out") : "", with_places);
  const auto panoramas = placeRows<urban_nav_store::StoredPlace>(folder.file("once/session.db"));
  const auto keyframes = placeRows<urban_nav_store::StoredKeyframePlace>(folder.file("once/session.db"));
  EXPECT_EQ(panoramas.size(), static_cast<std::size_t>(kFrames));
  ASSERT_GE(keyframes.size(), 2U);
  EXPECT_LT(keyframes.size(), static_cast<std::size_t>(kFrames));
  for (const auto& row : panoramas) EXPECT_EQ(row.cameras, 5);
  for (const auto& row : keyframes) {
    EXPECT_EQ(row.cameras, 1);
    EXPECT_EQ(row.status, "used");
    EXPECT_FALSE(row.words.empty());
    EXPECT_TRUE(row.thumbnail.empty()) << "the keyframe has the image";
  }
  const auto in_parts = placeRows<urban_nav_store::StoredKeyframePlace>(folder.file("out/session.db"));
  ASSERT_EQ(in_parts.size(), keyframes.size());
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    EXPECT_EQ(in_parts[i].stamp, keyframes[i].stamp);
    EXPECT_EQ(in_parts[i].words, keyframes[i].words);
    EXPECT_EQ(in_parts[i].descriptors, keyframes[i].descriptors);
  }
}

// What ties moments of the first bag together still does when the others have come.
TEST_F(Split, KeepsTheClosuresOfTheBagsBefore) {
  const urban_nav_core::Trajectory way = urban_nav_core::readTum(whole() + "/trajectory.tum");
  urban_nav_core::ClosureRow row;
  row.a = {"part_0", way[2].stamp};
  row.b = {"part_0", way[12].stamp};
  row.method = urban_nav_core::ClosureMethod::Stereo;
  row.T_a_b = way[2].pose.inverse() * way[12].pose *
              urban_nav_core::Pose(urban_nav_core::Quaterniond::Identity(), {0.002, 0.001, 0.0});
  urban_nav_input::testing::writeFile(folder.file("closures.csv"), urban_nav_core::printClosures({row}));
  const auto with_graph = [](MapOptions& request) { request.stages = {"vo", "graph"}; };
  const auto with_closures = [&](MapOptions& request) {
    with_graph(request);
    request.closures = folder.file("closures.csv");
  };
  map(parts(), folder.file("once"), {}, with_closures);
  map({part(0)}, folder.file("out"), {}, with_closures);
  map({part(1)}, folder.file("out"), folder.file("out"), with_graph);
  map({part(2)}, folder.file("out"), folder.file("out"), with_graph);
  EXPECT_NE(readFile(folder.file("once/closures.csv")).find("accepted"), std::string::npos);
  for (const char* name : {"closures.csv", "trajectory.tum", "covariance.csv"})
    EXPECT_EQ(readFile(folder.file("once/") + name), readFile(folder.file("out/") + name)) << name;
  EXPECT_FALSE(readFile(folder.file("out/trajectory.tum")) == readFile(whole() + "/trajectory.tum"));
}

TEST_F(Split, IsAnotherSessionWhereItCannotGoOn) {
  const std::string out = folder.file("out");
  map({part(0)}, out);
  const std::string first = readFile(out + "/trajectory.tum");
  const auto other_window = [](MapOptions& request) { request.parameters.set("swf_vo.window=7"); };
  const std::string said = map({part(1)}, folder.file("other"), out, other_window);
  EXPECT_NE(said.find("does not continue session part_0.bag: other parameters"), std::string::npos) << said;
  EXPECT_EQ(readStoreInfo(folder.file("other/session.db")).sessions.size(), 2U);
  urban_nav_input::testing::delayBag(part(1), folder.file("late_1.bag"), 100.0);
  map({folder.file("late_1.bag")}, folder.file("late"), out);
  const StoreInfo info = readStoreInfo(folder.file("late/session.db"));
  ASSERT_EQ(info.sessions.size(), 2U);
  EXPECT_FALSE(info.sessions[0].next_bag) << "what comes now goes on in the last one";
  EXPECT_TRUE(info.sessions[1].next_bag);
  map({part(0)}, out, out);
  EXPECT_TRUE(readFile(out + "/trajectory.tum") == first) << "mapped again, it is replaced";
  EXPECT_EQ(readStoreInfo(out + "/session.db").sessions.size(), 1U);
}

std::uintmax_t storeBytes(const std::string& out) { return fs::file_size(out + "/session.db"); }

// A bag that is not numbered is the whole recording: its store has no state of a filter. One that follows nevertheless
// is a session of its own, with a reason; both at once are one session.
TEST_F(Split, KeepsNoStateOfAWholeRecording) {
  const std::string first = folder.file("first.bag"), second = folder.file("second.bag"), out = folder.file("out");
  fs::copy_file(part(0), first);
  fs::copy_file(part(1), second);
  map({part(0)}, folder.file("part"));
  map({first}, out);
  EXPECT_FALSE(readStoreInfo(out + "/session.db").sessions[0].next_bag);
  EXPECT_LT(readStoreInfo(out + "/session.db").sessions[0].state_bytes, 10'000);
  EXPECT_LT(storeBytes(out) + 200'000, storeBytes(folder.file("part")));
  EXPECT_TRUE(readFile(out + "/trajectory.tum") == readFile(folder.file("part/trajectory.tum")));
  const std::string output = map({second}, folder.file("apart"), out);
  EXPECT_NE(output.find("second.bag follows session first.bag, but becomes a session of its own"), std::string::npos)
      << output;
  EXPECT_EQ(readStoreInfo(folder.file("apart/session.db")).sessions.size(), 2U);
  map({first, second, part(2)}, folder.file("together"), out);
  EXPECT_EQ(readStoreInfo(folder.file("together/session.db")).sessions.size(), 1U);
  for (const std::string& name : kSameWhenSplit)
    EXPECT_TRUE(readFile(whole() + "/" + name) == readFile(folder.file("together/" + name))) << name;
}

/// Without times of day and durations.
std::string timeless(const std::string& path) {
  const std::string text = readFile(path);
  if (path.find("stats.csv") != std::string::npos) return std::regex_replace(text, std::regex(",[0-9.e-]+(?=\n)"), "");
  static const std::regex times("\"(wall_s|cpu_s|peak_rss_bytes|realtime_factor|[a-z0-9_]*ms[a-z0-9_]*)\": [^,\n}]+");
  return std::regex_replace(text, times, "");
}

std::vector<std::string> makePictures(const std::string& path) {
  const std::string text = readFile(path);
  std::vector<std::string> pictures;
  for (std::size_t at = 0; (at = text.find("data:image/jpeg", at)) != std::string::npos; ++at)
    pictures.push_back(text.substr(at, text.find('"', at) - at));
  return pictures;
}

TEST_F(Split, ResumesAfterItsLastBagAfterAKill) {
  std::vector<std::string> words = {"map", "--stages", "vo", "--threads", "1", "--out", folder.file("cut")};
  for (const std::string& input : parts()) words.push_back(input);
  int kills = 0;
  for (int round = 0; round < 8 && kills < 3; ++round) {
    fs::remove_all(folder.file("cut"));
    std::size_t bags = 0;
    const std::size_t wanted = 1 + static_cast<std::size_t>(round % 2);
    testing::Child child(words, folder.file("log"));
    const auto status = child.endOr([&] {
      try {
        urban_nav_store::Store store(folder.file("cut/session.db"), urban_nav_store::Access::Read);
        const auto sessions = store.sessions().all();
        const auto state = sessions.empty() ? std::nullopt : store.states().get(sessions.front().id, kBagStage);
        bags = state ? unpackBagCheckpoint(*state).bags.size() : 0;
      } catch (const urban_nav_core::Error&) {
        return false;  // not there yet
      }
      return bags >= wanted;
    });
    if (status) continue;  // it was faster
    ++kills;
    testing::Child again(words, folder.file("log"));
    EXPECT_EQ(again.endOr([] { return false; }), 0) << readFile(folder.file("log"));
    const std::string log = readFile(folder.file("log"));
    const bool finished = log.find("1 of 1 session complete") != std::string::npos;
    EXPECT_TRUE(finished || log.find("continuing after the last complete bag") != std::string::npos) << log;
    expectWhole(folder.file("cut"));
    for (const char* name : {"stats.csv", "summary.json"}) {
      std::string there = timeless(whole() + "/" + name), here = timeless(folder.file("cut/") + name);
      EXPECT_EQ(there, here) << name;
    }
    EXPECT_EQ(makePictures(whole() + "/report.html"), makePictures(folder.file("cut/report.html")));
    EXPECT_FALSE(makePictures(whole() + "/report.html").empty());
  }
  EXPECT_GT(kills, 0);
}

}  // namespace
}  // namespace urban_nav
