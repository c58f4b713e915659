// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include "parameters/example_table.hpp"

namespace urban_nav_core::testing {
namespace {

// Depends on window and forget, and on noise if robust.
std::string print(const Example& example) {
  return std::to_string(example.window) + example.forget + (example.robust ? printValue(example.noise) : "");
}

const std::vector<ParameterTest> kElsewhere = {{"switch", "ParameterEffects.AreFoundForEachRow"},
                                               {"name", "ParameterEffects.AreFoundForEachRow"}};

TEST(ParameterEffects, AreFoundForEachRow) {
  EXPECT_EQ(findParametersWithoutEffect(exampleTable(),
                                        {{"noise", print, {{"noise", 0.1}, {"robust", false}}},
                                         {"plain", print, {{"window", 5}, {"forget", "delete"}}, {{"robust", false}}}},
                                        kElsewhere),
            "");
}

TEST(ParameterEffects, AreMissingWithNameForARowWithoutCase) {
  EXPECT_EQ(
      findParametersWithoutEffect(
          exampleTable(), {{"all", print, {{"noise", 0.1}, {"robust", false}, {"forget", "delete"}}}}, kElsewhere),
      "stage.window has no test in which it changes a result\n");
}

TEST(ParameterEffects, AreMissingWhereTheResultStaysTheSame) {
  const std::string faults =
      findParametersWithoutEffect(exampleTable(),
                                  {{"all", print, {{"window", 5}, {"forget", "delete"}, {"robust", false}}},
                                   {"not robust", print, {{"noise", 0.1}}, {{"robust", false}}}},
                                  kElsewhere);
  EXPECT_EQ(faults, "stage.noise = 0.1 does not change the result (not robust)\n");
}

TEST(ParameterEffects, NeedOtherValuesThatAreAllowed) {
  const std::string faults = findParametersWithoutEffect(
      exampleTable(),
      {{"all", print, {{"window", 10}, {"forget", "keep"}, {"robust", false}, {"noise", 0.1}, {"gone", 1}}}},
      kElsewhere);
  EXPECT_EQ(faults,
            "stage.window = 10 is the value without the change (all)\n"
            "stage.forget = keep is not allowed: schur, delete (all)\n"
            "stage.gone = 1 is no row of the table (all)\n");
}

TEST(ParameterEffects, AreNotTakenFromRunsThatDifferByThemselves) {
  int run = 0;
  const auto count = [&run](const Example&) { return std::to_string(++run); };
  const std::string faults = findParametersWithoutEffect(exampleTable(), {{"counter", count, {{"window", 5}}}}, {});
  EXPECT_EQ(faults.substr(0, faults.find('\n')), "counter: two equal runs differ");
}

TEST(ParameterEffects, AreShownElsewhereByTestsThatExist) {
  const std::string faults = findParametersWithoutEffect(
      exampleTable(), {{"all", print, {{"window", 5}, {"noise", 0.1}, {"robust", false}, {"forget", "delete"}}}},
      {{"switch", "ParameterEffects.IsNotThere"}, {"gone", "ParameterEffects.AreFoundForEachRow"}});
  EXPECT_EQ(faults,
            "switch: there is no test ParameterEffects.IsNotThere\n"
            "gone is no row of the table\n"
            "stage.name has no test in which it changes a result\n");
}

TEST(ParameterEffects, AreShownByTestsOfOtherBinaries) {
  const std::string folder = "test/parameters";
  const ParameterExperiment<Example> all = {
      "all", print, {{"window", 5}, {"noise", 0.1}, {"robust", false}, {"forget", "delete"}}};
  EXPECT_EQ(findParametersWithoutEffect(
                exampleTable(), {all},
                {{"switch", "Table.StatesTheAllowedValues", folder}, {"name", "Table.SaysNothing", folder}}),
            "name: there is no test Table.SaysNothing\n");
}

}  // namespace
}  // namespace urban_nav_core::testing
