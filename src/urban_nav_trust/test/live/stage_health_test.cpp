// SPDX-License-Identifier: BSD-3-Clause
#include "live/stage_health.hpp"

#include <gtest/gtest.h>

namespace urban_nav_trust {
namespace {

TEST(StageHealth, NamesWhatIsNotOkErrorsFirst) {
  StageHealth health;
  EXPECT_EQ(health.text(0.0).lines, "") << "before any diagnostics";
  health.add("dense_stereo: disparities", StageHealth::kOk, "OK", 1.0);
  health.add("swf_vo: frames", StageHealth::kWarning, "left camera is dark", 1.0);
  health.add("laser_mapper: map", StageHealth::kError, "no odometry", 1.0);
  const StageHealth::Text text = health.text(2.0);
  EXPECT_EQ(text.level, StageHealth::kError);
  EXPECT_EQ(text.lines, "laser_mapper: map: no odometry\nswf_vo: frames: left camera is dark");
  health.add("laser_mapper: map", StageHealth::kOk, "OK", 2.0);
  EXPECT_EQ(health.text(2.0).level, StageHealth::kWarning);
  health.add("swf_vo: frames", StageHealth::kOk, "OK", 2.0);
  EXPECT_EQ(health.text(2.0).level, StageHealth::kOk);
  EXPECT_EQ(health.text(2.0).lines, "all 3 nodes are OK");
}

TEST(StageHealth, ANodeThatFellSilentIsAnError) {
  StageHealth health;
  health.add("swf_vo: frames", StageHealth::kOk, "OK", 10.0);
  EXPECT_EQ(health.text(10.0 + StageHealth::kSilence).level, StageHealth::kOk);
  const StageHealth::Text text = health.text(17.0);
  EXPECT_EQ(text.level, StageHealth::kError);
  EXPECT_EQ(text.lines, "swf_vo: frames: no diagnostics for 7 s");
}

TEST(StageHealth, LongSentencesAreWrappedAtBlanks) {
  EXPECT_EQ(wrapText("one two three four", 9), "one two\nthree\nfour");
  EXPECT_EQ(wrapText("unbreakable", 4), "unbreakable");
  EXPECT_EQ(wrapText("", 4), "");
}

}  // namespace
}  // namespace urban_nav_trust
