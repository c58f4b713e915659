// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/old_names.hpp"

#include <gtest/gtest.h>

#include "io/reader_check.hpp"
#include "urban_nav_core/parameters/sources.hpp"

namespace urban_nav_core {
namespace {

struct Camera {
  double disparity_offset;
  int queue_size;
};

const Table<Camera>& cameraTable() {
  static const Table<Camera> table(
      "camera", {{"disparity_offset",
                  &Camera::disparity_offset,
                  "px",
                  0.1,
                  0.0,
                  5.0,
                  {},
                  "An error.",
                  "",
                  {"vo.disparity_offset", "loops.disparity_offset"}},
                 {"queue_size", &Camera::queue_size, "", 10, 1, 100, {}, "A length.", "", {"queue", "pending"}}});
  return table;
}

std::vector<StageRows> tables() { return {{"camera", cameraTable().rows()}}; }

TEST(OldNames, AreUnderstoodWithAWarningThatNamesTheNewOne) {
  const auto loaded = load(cameraTable(), parseParameters("camera:\n  queue: 7\n", "config.yaml"));
  EXPECT_EQ(loaded.parameters.queue_size, 7);
  EXPECT_EQ(loaded.settings[1].origin, "config.yaml:2");
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"config.yaml:2: camera.queue is now called camera.queue_size"});
  EXPECT_TRUE(load(cameraTable(), {parseSetting("camera.queue_size=7")}).warnings.empty());
}

TEST(OldNames, MayBeOfAnotherStage) {
  const auto loaded = load(cameraTable(), {parseSetting("loops.disparity_offset=0.2")});
  EXPECT_EQ(loaded.parameters.disparity_offset, 0.2);
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_NE(loaded.warnings[0].find("camera.disparity_offset"), std::string::npos);
}

TEST(OldNames, OfOneParameterWithTwoValuesAreNamedTogether) {
  const auto both = [](const std::string& one, const std::string& other) {
    return replaceOldNames({parseSetting(one), parseSetting(other)}, tables());
  };
  EXPECT_EQ(both("vo.disparity_offset=0.2", "loops.disparity_offset=0.2").warnings.size(), 2U);
  const auto differ = both("vo.disparity_offset=0.2", "loops.disparity_offset=0.3");
  ASSERT_EQ(differ.warnings.size(), 3U);
  for (const char* part : {"vo.disparity_offset = 0.2", "loops.disparity_offset = 0.3", "camera.disparity_offset"})
    EXPECT_NE(differ.warnings[2].find(part), std::string::npos) << differ.warnings[2];
  EXPECT_EQ(both("camera.queue=2", "camera.queue=3").warnings.size(), 2U) << "one key, overridden as usual";
}

TEST(OldNames, LastAssignmentCountsUnderWhateverName) {
  const auto toValue = [](const std::vector<Assignment>& assignments) {
    return load(cameraTable(), assignments).parameters.queue_size;
  };
  EXPECT_EQ(toValue({parseSetting("camera.queue=2"), parseSetting("camera.queue_size=3")}), 3);
  EXPECT_EQ(toValue({parseSetting("camera.queue_size=3"), parseSetting("camera.queue=2")}), 2);
}

TEST(OldNames, AreCheckedAndReportedAsTheParameterThatTheyAre) {
  EXPECT_EQ(catchError([] { load(cameraTable(), {parseSetting("camera.queue=0")}); }),
            "--set camera.queue=0: camera.queue_size = 0: allowed 1...100");
  EXPECT_NE(catchError([] { load(cameraTable(), {parseSetting("camera.queu=1")}); }).find("nearest: camera.queue_size"),
            std::string::npos);
}

struct Memory {
  std::string keeps;
  bool first;
};

const Table<Memory>& memoryTable() {
  static const Table<Memory> table(
      "memory",
      {{"keeps", &Memory::keeps, "", "all", false, false, {"all", "none"}, "What.", "", {"forget: delete = none"}},
       {"first", &Memory::first, "", true, false, false, {}, "When.", "", {"when: first = true, latest = false"}}});
  return table;
}

TEST(OldNames, HaveOldWords) {
  const auto loaded = load(memoryTable(), {parseSetting("memory.forget=delete"), parseSetting("memory.when=latest")});
  EXPECT_EQ(loaded.parameters.keeps, "none");
  EXPECT_FALSE(loaded.parameters.first);
  EXPECT_EQ(loaded.warnings, (std::vector<std::string>{
                                 "--set memory.forget=delete: memory.forget = delete is now called memory.keeps = none",
                                 "--set memory.when=latest: memory.when = latest is now called memory.first = false"}));
  EXPECT_EQ(load(memoryTable(), {parseSetting("memory.forget=all")}).parameters.keeps, "all");
  EXPECT_EQ(catchError([] { load(memoryTable(), {parseSetting("memory.keeps=delete")}); }),
            "--set memory.keeps=delete: memory.keeps = delete: allowed all, none")
      << "new name, old value";
}

TEST(OldNames, WordsOfTheParameterServerBecomeSwitches) {
  const auto loaded = load(memoryTable(), {{"memory", "when", "latest", false, "/memory/when"}});
  EXPECT_FALSE(loaded.parameters.first);
  EXPECT_TRUE(isCalled(memoryTable().rows()[1], "when"));
}

TEST(OldNames, AssignmentsToOthersAreLeftAlone) {
  const auto renamed = replaceOldNames({parseSetting("vo.queue=1"), parseSetting("memory_mb=1")}, tables());
  EXPECT_TRUE(renamed.warnings.empty());
  EXPECT_EQ(renamed.assignments[0].name, "queue");
  EXPECT_EQ(renamed.assignments[1].stage, "");
}

TEST(OldNames, CountWithoutStageInANameSpaceOfOneNodelet) {
  const RowInfo& offset = cameraTable().rows()[0];
  EXPECT_TRUE(isCalled(offset, "disparity_offset"));
  EXPECT_TRUE(isCalled(cameraTable().rows()[1], "queue"));
  EXPECT_FALSE(isCalled(offset, "queue"));
  EXPECT_FALSE(isCalled(offset, ""));
}

}  // namespace
}  // namespace urban_nav_core
