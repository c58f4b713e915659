// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/sources.hpp"

#include <cmath>
#include <stdexcept>

#include "io/reader_check.hpp"
#include "parameters/example_table.hpp"

namespace urban_nav_core {
namespace {

const char* const kYaml =
    "# a comment\nstage:\n  window: 25\n  noise: 1\n  forget: delete\n  switch: off\nother:\n  window: 3\n"
    "memory_mb: 100\n";

Loaded<Example> loadText(const std::string& text) { return load(exampleTable(), parseParameters(text, "config.yaml")); }

const Setting& find(const Loaded<Example>& loaded, const std::string& name) {
  for (const Setting& setting : loaded.settings) {
    if (setting.name == name) return setting;
  }
  throw std::out_of_range(name);
}

TEST(Sources, YamlOverridesDefaults) {
  const auto loaded = loadText(kYaml);
  EXPECT_EQ(loaded.parameters.window, 25);
  EXPECT_EQ(loaded.parameters.noise, 1.0);
  EXPECT_EQ(loaded.parameters.forget, "delete");
  EXPECT_EQ(loaded.parameters.switch_, "off");
  EXPECT_TRUE(loaded.parameters.robust);
  EXPECT_EQ(find(loaded, "window").origin, "config.yaml:3");
  EXPECT_EQ(find(loaded, "robust").origin, "default");
  EXPECT_EQ(loadText("").parameters.window, 10);
  EXPECT_EQ(loadText("stage:\n").parameters.window, 10);
}

TEST(Sources, LaterOnesOverrideAndReportTheirOrigin) {
  auto assignments = parseParameters(kYaml, "config.yaml");
  for (const auto& each : serverParameters("stage", {{"window", 30}, {"switch", true}, {"noise", 2}}, "/vo"))
    assignments.push_back(each);
  auto loaded = load(exampleTable(), assignments);
  EXPECT_EQ(loaded.parameters.window, 30);
  EXPECT_EQ(loaded.parameters.noise, 2.0);
  EXPECT_EQ(loaded.parameters.switch_, "on") << "the parameter server converts on to a boolean";
  EXPECT_EQ(find(loaded, "window").origin, "/vo/window");
  assignments.push_back(parseSetting("stage.window = 40"));
  loaded = load(exampleTable(), assignments);
  EXPECT_EQ(loaded.parameters.window, 40);
  EXPECT_EQ(find(loaded, "window").origin, "--set stage.window = 40");
  EXPECT_EQ(loaded.parameters.forget, "delete");
}

TEST(Sources, ErrorsNameFileLineKeyValueAndWhatIsAllowed) {
  EXPECT_EQ(catchError([] { loadText("stage:\n\n  window: 0\n"); }),
            "config.yaml:3: stage.window = 0: allowed 1...100000 (frames)");
  EXPECT_EQ(catchError([] { loadText("stage:\n  window: 2.5\n"); }),
            "config.yaml:2: stage.window = 2.5: allowed 1...100000 (frames)");
  EXPECT_EQ(catchError([] { loadText("stage:\n  noise: nan\n"); }),
            "config.yaml:2: stage.noise = nan: allowed numbers 0.001...5 (px)");
  EXPECT_EQ(catchError([] { loadText("stage:\n  robust: 1\n"); }),
            "config.yaml:2: stage.robust = 1: allowed true, false");
  EXPECT_EQ(catchError([] { loadText("stage:\n  forget: keep\n"); }),
            "config.yaml:2: stage.forget = keep: allowed schur, delete");
  EXPECT_EQ(catchError([] { loadText("stage:\n  windw: 3\n"); }),
            "config.yaml:2: stage.windw is not a parameter: expected the parameters that --help-all lists; nearest: "
            "stage.window");
  EXPECT_EQ(catchError([] { loadText("stage:\n  window: [1]\n"); }),
            "config.yaml:2: stage.window is not a single value: expected one value after the colon");
  EXPECT_EQ(catchError([] { loadText("stage:\n  window: 1\n  window: 2\n"); }),
            "config.yaml:3: duplicate key stage.window");
  EXPECT_EQ(catchError([] { loadText("stage:\n  window: 1\nstage:\n  noise: 2\n"); }),
            "config.yaml:3: duplicate key stage");
  EXPECT_EQ(catchError([] { loadText("- 1\n"); }), "config.yaml:1: no map of stages: expected lines such as `swf_vo:`");
  EXPECT_NE(catchError([] { loadText("stage: [\n"); }).find("config.yaml:"), std::string::npos);
  EXPECT_EQ(catchError([] { load(exampleTable(), {parseSetting("stage.window=x")}); }),
            "--set stage.window=x: stage.window = x: allowed 1...100000 (frames)");
  EXPECT_EQ(catchError([] {
              load(exampleTable(), serverParameters("stage", {{"window", "25"}}, "/vo"));
            }),
            "/vo/window: stage.window = \"25\": allowed 1...100000 (frames)");
}

TEST(Sources, RemovedParametersAreNamedAsSuch) {
  struct Filter {
    int window;
  };
  const Table<Filter> table("swf_vo", {{"window", &Filter::window, "frames", 10, 1, 100, {}, "A length.", ""}});
  EXPECT_EQ(catchError([&] { load(table, parseParameters("swf_vo:\n  marginalization: none\n", "config.yaml")); }),
            "config.yaml:2: swf_vo.marginalization was removed: poses and landmarks that leave the window are always "
            "marginalised; the program swf_vo-bench-plain measures odometry that deletes them");
  EXPECT_EQ(catchError([&] { load(table, {parseSetting("swf_vo.subpixel=false")}); }),
            "--set swf_vo.subpixel=false: swf_vo.subpixel was removed: corners are always placed to subpixels");
  EXPECT_NE(catchError([&] { load(table, {parseSetting("swf_vo.subpixels=false")}); }).find("nearest: swf_vo.window"),
            std::string::npos);
}

TEST(Sources, UnknownStagesAreRefused) {
  const auto assignments = parseParameters(kYaml, "config.yaml");
  EXPECT_EQ(catchError([&] {
              refuseUnknownStages(assignments, {"stage", "others", ""});
            }),
            "config.yaml:8: other is not a stage: expected stage, others, none; nearest: others");
  EXPECT_EQ(catchError([&] {
              refuseUnknownStages(assignments, {"stage", "other"});
            }),
            "config.yaml:9: memory_mb has no stage prefix: expected stage, other; nearest: stage");
  EXPECT_EQ(catchError([&] { refuseUnknownStages(assignments, {"stage", "other", ""}); }), "");
}

TEST(Sources, SettingsOfTheCommandLine) {
  const Assignment a = parseSetting("memory_mb=500");
  EXPECT_EQ(a.stage, "");
  EXPECT_EQ(a.name, "memory_mb");
  EXPECT_EQ(std::get<std::string>(parseSetting("stage.name=a=b").value), "a=b");
  EXPECT_EQ(catchError([] { parseSetting("stage.window"); }),
            "--set stage.window: no key and value: expected stage.key=value");
  EXPECT_NE(catchError([] { parseSetting("=3"); }), "");
}

TEST(Sources, Fuzzed) {
  expectSurvives(testing::fuzzText({kYaml, "stage: {window: 5, name: \"x y\"}\n"}, [](const std::string& text) {
    const Example example = loadText(text).parameters;
    if (!std::isfinite(example.noise) || example.window < 1) throw std::runtime_error("a value that is not allowed");
  }));
  expectSurvives(testing::fuzzText({"stage.window=25", "stage.noise=1e-2"},
                                   [](const std::string& text) { load(exampleTable(), {parseSetting(text)}); }));
}

}  // namespace
}  // namespace urban_nav_core
