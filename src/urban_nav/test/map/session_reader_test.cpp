// SPDX-License-Identifier: BSD-3-Clause
#include "map/session_reader.hpp"

#include <gtest/gtest.h>

#include "base/parameters.hpp"
#include "commands/stages.hpp"
#include "topics/vo/vo.hpp"
#include "urban_nav_core/testing/parameter_effects.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

constexpr int kFramesRead = 6;

/// Counts the frames of a session, and how often its session was restored.
class CountingStage final : public Stage {
 public:
  Description describe() const override { return {"count", "count", true, false, false, {}}; }
  std::unique_ptr<SessionPass> beginSession(MapContext&, const SessionStart&) override {
    return std::make_unique<Pass>(frames);
  }
  bool restoreSession(MapContext&, std::size_t, std::string_view finished) override {
    restored = std::string(finished);
    return true;
  }

  int frames = 0;
  std::string restored;

 private:
  class Pass final : public SessionPass {
   public:
    explicit Pass(int& count) : count_(count) {}
    void process(PassItem& item) override {
      ASSERT_NE(item.odometry, nullptr) << "stage vo comes first";
      EXPECT_EQ(item.odometry->stamp, item.input.assembled.pair.stamp);
      EXPECT_EQ(item.odometry->frame, frame_++);
      ++count_;
    }
    std::string finished() override { return std::to_string(count_); }

   private:
    std::int64_t frame_ = 0;
    int& count_;
  };
};

/// Reads a folder as one run of `map` does, without ending the run.
class SessionReaderTest : public ::testing::Test {
 protected:
  SessionReaderTest() {
    urban_nav_input::testing::KittiStyle style;
    style.frames = kFramesRead;
    urban_nav_input::testing::makeKittiFolder(folder.file("in"), style);
    options.inputs = {folder.file("in")};
    options.out = folder.file("out");
    options.threads = 1;
    options.parameters = loadParameters(Arguments({}, addStageTables));
    vo = makeVoStage();
  }
  void read() {
    MapContext context(options, console);
    context.sessions.emplace_back();
    context.sessions.front().input = urban_nav_input::findSessions(options.inputs).front();
    const StageList stages = {vo.get(), &counting};
    RunCheckpoint checkpoint(options, stages, context.sessions, folder.file("session.db"), console);
    context.store = &checkpoint.store();
    SessionReader reader(context, stages, checkpoint, 0);
    reader.openResumed();
    reader.open();
    reader.read([this](double share) { last_share = share; });
    rows = context.sessions.front().odometry->frames.size();
  }

  const urban_nav_input::testing::TemporaryFolder folder;
  MapOptions options;
  Console console;
  std::unique_ptr<Stage> vo;
  CountingStage counting;
  double last_share = -1.0;
  std::size_t rows = 0;
};

TEST_F(SessionReaderTest, AllStagesObserveTheOnePassAndAreRestoredAfterAnInterruption) {
  read();
  EXPECT_EQ(counting.frames, kFramesRead);
  EXPECT_EQ(rows, static_cast<std::size_t>(kFramesRead));
  EXPECT_EQ(last_share, 1.0);
  EXPECT_EQ(counting.restored, "");
  read();
  EXPECT_EQ(counting.frames, kFramesRead) << "nothing is read again";
  EXPECT_EQ(counting.restored, std::to_string(kFramesRead));
  EXPECT_EQ(rows, static_cast<std::size_t>(kFramesRead));
}

TEST_F(SessionReaderTest, ASessionIsReadAgainWithOtherParameters) {
  read();
  options.parameters.set("swf_vo.window=7");
  read();
  EXPECT_EQ(counting.frames, 2 * kFramesRead);
  EXPECT_EQ(counting.restored, "");
}

TEST(SessionReader, ReadsAheadWhatFitsIntoTheMemory) {
  const auto depth = [](const CommandParameters& parameters) {
    return std::to_string(readAheadDepth(parameters, {2000.0, 2000.0, 2000.0, 1500.0, 4000, 3000}));
  };
  EXPECT_EQ(urban_nav_core::testing::findParametersWithoutEffect(commandTable(),
                                                                 {{"pairs of 24 MB", depth, {{"memory_mb", 200}}}}),
            "");
}

}  // namespace
}  // namespace urban_nav
