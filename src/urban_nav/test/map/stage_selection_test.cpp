// SPDX-License-Identifier: BSD-3-Clause
#include "map/stage_selection.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/parameters.hpp"
#include "commands/stages.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::UserError;

class StageSelectionTest : public ::testing::Test {
 protected:
  StageSelectionTest() : stages(makeStages()) { options.parameters = loadParameters(Arguments({}, addStageTables)); }

  std::vector<std::string> select() {
    std::vector<std::string> names;
    ::testing::internal::CaptureStderr();
    for (const Stage* stage : selectStages(stages, options, console)) names.push_back(stage->describe().name);
    printed = ::testing::internal::GetCapturedStderr();
    return names;
  }

  const std::vector<std::unique_ptr<Stage>> stages;
  MapOptions options;
  Console console;
  std::string printed;
};
using Names = std::vector<std::string>;

TEST_F(StageSelectionTest, NamesAndKeysAreUniqueAndOdometryComesFirst) {
  std::set<std::string> names, keys;
  for (const std::unique_ptr<Stage>& stage : stages) {
    EXPECT_TRUE(names.insert(stage->describe().name).second) << stage->describe().name;
    EXPECT_TRUE(keys.insert(stage->describe().key).second) << stage->describe().key;
  }
  EXPECT_EQ(stages.front()->describe().name, "vo");
}

TEST_F(StageSelectionTest, SelectsAllWithoutAWord) {
  EXPECT_EQ(select(), (Names{"vo", "lo", "fusion", "keyframes", "sweeps", "places", "stereo", "loops", "graph",
                             "lasers", "labels", "trust"}));
  EXPECT_EQ(printed.find("left out: "), std::string::npos) << printed;
  EXPECT_NE(printed.find("closures: those proposed by places"), std::string::npos) << printed;
  options.stages = {"vo", "loops", "graph"};
  EXPECT_EQ(select(), (Names{"vo", "keyframes", "loops", "graph"}));
  EXPECT_NE(printed.find("closures: none"), std::string::npos) << printed;
}

TEST_F(StageSelectionTest, SelectsWhatIsRequestedAndWhatThatNeeds) {
  options.stages = {"vo"};
  options.closures = "closures.csv";
  EXPECT_EQ(select(), Names{"vo"});
  EXPECT_NE(printed.find("--closures is not used"), std::string::npos) << printed;
  options.stages = {"graph"};
  EXPECT_EQ(select(), (Names{"vo", "graph"}));
  EXPECT_NE(printed.find("with the transforms in the file"), std::string::npos) << printed;
  options.stages = {"loops"};
  EXPECT_EQ(select(), (Names{"vo", "keyframes", "loops"}));
}

TEST_F(StageSelectionTest, CalibratesBeforeClosuresAreMeasured) {
  options.calibrate = true;
  EXPECT_EQ(select(), (Names{"vo", "lo", "fusion", "keyframes", "sweeps", "places", "stereo", "calibration", "loops",
                             "graph", "lasers", "labels", "trust"}));
  options.stages = {"vo", "loops", "graph"};
  EXPECT_THROW(select(), UserError) << "there is nothing to calibrate without lasers";
  ::testing::internal::GetCapturedStderr();
}

TEST_F(StageSelectionTest, LocalizationTakesThePlaceOfMapping) {
  const urban_nav_input::testing::TemporaryFolder folder;
  options.localise = folder.file("map.db");
  EXPECT_THROW(select(), urban_nav_core::Error) << "there is no such store";
  ::testing::internal::GetCapturedStderr();
  urban_nav_store::Store(options.localise, urban_nav_store::Access::Write).commit();
  EXPECT_EQ(select(), (Names{"vo", "lo", "fusion", "keyframes", "sweeps", "localization"}));
  options.store = options.localise;
  EXPECT_THROW(select(), UserError);
  ::testing::internal::GetCapturedStderr();
}

TEST_F(StageSelectionTest, RefusesUnknownWordsAndStagesThatAreNotSelectable) {
  for (const char* word : {"vision", "keyframes"}) {
    options.stages = {word};
    EXPECT_THROW(select(), UserError) << word;
    ::testing::internal::GetCapturedStderr();
  }
}

}  // namespace
}  // namespace urban_nav
