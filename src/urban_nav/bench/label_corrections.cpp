// SPDX-License-Identifier: BSD-3-Clause
// Gain by corrections as `labels teach` takes them: a scripted user gives the suggested places of a labelled scene the
// class that most of their returns have, one after another, and the model answers again.
//
//   urban_nav-bench-label_corrections MODEL SCENE CLASSES [CORRECTIONS [RADIUS]]
//
// CLASSES: as of `labels --classes`; CORRECTIONS: 20 unless given; RADIUS: m around the suggested point, 0 unless
// given.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "scene_labeler/class_map.hpp"
#include "topics/labels/label_model_file.hpp"
#include "topics/labels/label_score.hpp"
#include "topics/labels/teach/scene_teacher.hpp"
#include "topics/labels/teach/teach_suggestions.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav::bench {

using scene_labeler::SceneClass;
using scene_labeler::SceneLabels;

/// Returns the most frequent class of some points; None if most have no truth.
SceneClass commonClass(const std::vector<std::uint32_t>& points, const std::vector<SceneClass>& truth) {
  std::map<SceneClass, std::size_t> counts;
  for (const std::uint32_t point : points) ++counts[truth[point]];
  SceneClass best = SceneClass::None;
  std::size_t most = 0;
  for (const auto& [label, count] : counts) {
    if (count <= most) continue;
    most = count;
    best = label;
  }
  return best;
}

void report(int corrections, const SceneLabels& answer, const std::vector<SceneClass>& truth, double seconds) {
  LabelScore score(true);
  score.add(answer, truth);
  std::size_t compared = 0, sure = 0, right = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] == SceneClass::None) continue;
    ++compared;
    if (answer.labels[i] == SceneClass::None || answer.unsure[i] != 0) continue;
    ++sure;
    right += withOneWall(answer.labels[i]) == withOneWall(truth[i]) ? 1U : 0U;
  }
  std::printf("%3d corrections: mean F1 %.3f, accuracy %.3f, sure %.3f, right of these %.3f; unlike %.2f; %.2f s\n",
              corrections, score.meanF1(), score.accuracy(), static_cast<double>(sure) / static_cast<double>(compared),
              static_cast<double>(right) / static_cast<double>(std::max<std::size_t>(sure, 1)), answer.share_unlike,
              seconds);
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "label_corrections MODEL SCENE CLASSES [CORRECTIONS [RADIUS]]\n");
    return 2;
  }
  const int count = argc > 4 ? std::atoi(argv[4]) : 20;
  const float radius = argc > 5 ? static_cast<float>(std::atof(argv[5])) : 0.0F;
  const SceneFiles files = findScenes({argv[2]}).front();
  const scene_labeler::ClassMap map(argv[3]);
  const std::vector<SceneClass> truth = map.toClasses(readSceneLabels(files, true), files.points);
  using Clock = std::chrono::steady_clock;
  auto begin = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  SceneTeacher::Options options;
  const SceneInput input = readScene(files);
  const SceneTeacher teacher(chooseModel(input, readLabelModel(argv[1]).model), argv[1], input.scene, options);
  report(0, teacher.answer(), truth, seconds());
  begin = Clock::now();
  const TeachUnits units(teacher.scene(), options.training.superpixel);
  const UnitKinds kinds(units, teacher.features(), teacher.base().bins);
  std::printf("%zu points, %zu units, %zu kinds; %.2f s\n", units.points(), units.size(), kinds.size(), seconds());
  CorrectionList corrections;
  SceneLabels answer = teacher.answer();
  std::vector<SceneClass> skipped(truth.size(), SceneClass::None);
  for (int given = 0; given < count;) {
    const std::vector<SceneClass> before = corrections.labels(units);
    std::vector<SceneClass> closed = before;
    for (std::size_t i = 0; i < closed.size(); ++i)
      if (skipped[i] != SceneClass::None) closed[i] = skipped[i];
    const auto suggested = suggestCorrections(units, kinds, answer, corrections.active(), closed, 1);
    if (suggested.empty()) break;
    const std::uint32_t point = suggested.front().point;
    const std::vector<std::uint32_t> members = units.members(units.unit(point));
    SceneClass label = commonClass(members, truth);
    const std::vector<SceneClass>& known = teacher.base().classes;
    if (label == SceneClass::Wall && std::find(known.begin(), known.end(), SceneClass::Wall) == known.end())
      label = suggested.front().label == SceneClass::SmoothWall ? SceneClass::SmoothWall : SceneClass::TexturedWall;
    if (label == SceneClass::None) {  // without a truth the user passes over it
      for (const std::uint32_t member : members) skipped[member] = SceneClass::Other;
      continue;
    }
    corrections.add({point, radius, label});
    begin = Clock::now();
    answer = teacher.answer(corrections.labels(units));
    const double took = seconds();
    ++given;
    std::printf("%-13s answered %-13s %.2f, %zu units, %.1f m2: ", toString(label), toString(suggested.front().label),
                suggested.front().probability, suggested.front().units, suggested.front().area);
    report(given, answer, truth, took);
  }
  return 0;
}

}  // namespace urban_nav::bench

int main(int argc, char** argv) {
  try {
    return urban_nav::bench::run(argc, argv);
  } catch (const urban_nav_core::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
