// SPDX-License-Identifier: BSD-3-Clause
// Corrections of a scene without a page: units, the list, its file, answers, and suggestions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "support/taught_yard.hpp"
#include "topics/labels/label_model_file.hpp"
#include "topics/labels/label_score.hpp"
#include "topics/labels/teach/correction_file.hpp"
#include "topics/labels/teach/scene_teacher.hpp"
#include "topics/labels/teach/teach_suggestions.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using scene_labeler::SceneClass;
using scene_labeler::SceneLabels;
using urban_nav_core::UserError;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_input::testing::writeFile;

constexpr int kSuperpixel = 12;

class Corrections : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    testing::writeTaughtYard(*folder_, folder_->file("m"), folder_->file("yard_points.csv"));
    SceneTeacher::Options options;
    options.name = "yard_corrections";
    teacher_ = std::make_unique<SceneTeacher>(readLabelModel(folder_->file("m")).model, "m", input().scene, options);
    units_ = std::make_unique<TeachUnits>(teacher_->scene(), kSuperpixel);
    kinds_ = std::make_unique<UnitKinds>(*units_, teacher_->features(), teacher_->base().bins);
  }
  static void TearDownTestSuite() {
    kinds_.reset();
    units_.reset();
    teacher_.reset();
    folder_.reset();
  }

  static SceneFiles files() { return findScenes({folder_->file("yard_points.csv")}).front(); }
  static SceneInput input() { return readScene(files()); }
  static const std::vector<SceneClass>& truth() {
    static const testing::Yard yard(3, true, false);
    return yard.truth;
  }
  CorrectionFile file(const std::string& name) const { return {path(name), files(), input(), kSuperpixel}; }
  std::string path(const std::string& name) const { return own_.file(name); }
  /// Gives the suggested units their true classes, one after another.
  static SceneLabels teach(int count, CorrectionList& corrections) {
    SceneLabels answer = teacher_->answer();
    for (int i = 0; i < count; ++i) {
      const std::vector<SceneClass> labels = corrections.labels(*units_);
      const auto suggested = suggestCorrections(*units_, *kinds_, answer, corrections.active(), labels, 1);
      if (suggested.empty()) break;
      corrections.add({suggested[0].point, 0.0F, truth()[suggested[0].point]});
      answer = teacher_->answer(corrections.labels(*units_));
    }
    return answer;
  }
  static double meanF1(const SceneLabels& answer) {
    LabelScore score(true);
    score.add(answer, truth());
    return score.meanF1();
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::unique_ptr<SceneTeacher> teacher_;
  static inline std::unique_ptr<TeachUnits> units_;
  static inline std::unique_ptr<UnitKinds> kinds_;
  const TemporaryFolder own_;
};

TEST_F(Corrections, UnitsPartitionTheFinitePoints) {
  scene_labeler::Scene scene = input().scene;
  scene.points[7].z() = std::numeric_limits<float>::quiet_NaN();
  const TeachUnits units(scene, kSuperpixel);
  std::vector<int> seen(scene.points.size(), 0);
  for (std::uint32_t unit = 0; unit < units.size(); ++unit) {
    const std::vector<std::uint32_t> members = units.members(unit);
    ASSERT_EQ(members.size(), units.count(unit));
    ASSERT_FALSE(members.empty());
    EXPECT_EQ(units.unit(units.middle(unit)), unit);
    EXPECT_GT(units.area(unit), 0.0F);
    for (const std::uint32_t point : members) {
      ++seen[point];
      EXPECT_EQ(units.unit(point), unit);
      EXPECT_LE((scene.points[point] - units.centre(unit)).norm(), 0.4F * std::sqrt(3.0F));
    }
  }
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], i == 7 ? 0 : 1) << i;
  EXPECT_EQ(units.unit(7), TeachUnits::kNone);
  EXPECT_TRUE(units.near(7, 1.0F).empty());
  const std::vector<std::uint32_t> one = units.near(100, 0.0F), more = units.near(100, 1.0F);
  EXPECT_EQ(one, std::vector<std::uint32_t>{units.unit(100)});
  EXPECT_GT(more.size(), one.size());
  EXPECT_TRUE(std::includes(more.begin(), more.end(), one.begin(), one.end()));
}

TEST_F(Corrections, LaterOnesPrevailUntilTheyAreUndone) {
  CorrectionList list;
  EXPECT_FALSE(list.undo());
  list.add({100, 0.0F, SceneClass::Grass});
  list.add({100, 0.0F, SceneClass::Vehicle});
  EXPECT_EQ(list.labels(*units_)[100], SceneClass::Vehicle);
  EXPECT_TRUE(list.undo());
  EXPECT_EQ(list.labels(*units_)[100], SceneClass::Grass);
  EXPECT_TRUE(list.redo());
  EXPECT_FALSE(list.redo());
  EXPECT_EQ(list.labels(*units_)[100], SceneClass::Vehicle);
  EXPECT_TRUE(list.undo());
  list.add({100, 0.0F, SceneClass::None});
  EXPECT_FALSE(list.canRedo()) << "a new correction ends what could be restored";
  const std::vector<SceneClass> labels = list.labels(*units_);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), SceneClass::None), static_cast<std::ptrdiff_t>(labels.size()));
}

TEST_F(Corrections, AreReadFromTheirFileAsTheyWere) {
  CorrectionList list;
  list.add({100, 0.0F, SceneClass::Vehicle});
  list.add({2500, 0.75F, SceneClass::Foliage});
  list.add({100, 0.5F, SceneClass::Wall});
  list.undo();
  const CorrectionFile written = file("c.ply");
  EXPECT_FALSE(written.exists());
  written.write(list, *units_);
  CorrectionList read = file("c.ply").read(*units_);
  EXPECT_EQ(read.active(), list.active());
  EXPECT_EQ(read.labels(*units_), list.labels(*units_));
  EXPECT_TRUE(read.undo());
  SceneFiles plain;
  plain.points = path("c.ply");
  const std::vector<std::int64_t> labels = readSceneLabels(plain, false);
  ASSERT_EQ(labels.size(), truth().size());
  EXPECT_EQ(labels[100], 7);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 255),
            static_cast<std::ptrdiff_t>(labels.size() - units_->count(units_->unit(100)) - [&] {
              std::size_t points = 0;
              for (const std::uint32_t unit : units_->near(2500, 0.75F)) points += units_->count(unit);
              return points;
            }()));
}

TEST_F(Corrections, LabelsOfAnotherProgramAreTheBaseOfTheList) {
  CorrectionList list;
  list.add({100, 0.0F, SceneClass::Vehicle});
  file("c.ply").write(list, *units_);
  std::string bytes = readFile(path("c.ply"));
  bytes.back() = 6;  // the last point becomes foliage
  writeFile(path("c.ply"), bytes);
  CorrectionList read = file("c.ply").read(*units_);
  EXPECT_FALSE(read.undo());
  const std::vector<SceneClass> labels = read.labels(*units_);
  EXPECT_EQ(labels.back(), SceneClass::Foliage);
  EXPECT_EQ(labels[100], SceneClass::Vehicle);
  read.add({100, 0.0F, SceneClass::Wall});
  file("c.ply").write(read, *units_);
  EXPECT_EQ(file("c.ply").read(*units_).labels(*units_).back(), SceneClass::Foliage);
}

TEST_F(Corrections, RefusesTheFileOfAnotherCloud) {
  CorrectionList list;
  list.add({100, 0.0F, SceneClass::Vehicle});
  file("c.ply").write(list, *units_);
  SceneInput moved = input(), shorter = input();
  moved.scene.points[5].x() += 0.01F;
  shorter.scene.points.pop_back();
  for (const SceneInput& other : {moved, shorter})
    EXPECT_THROW(CorrectionFile(path("c.ply"), files(), other, kSuperpixel).read(*units_), UserError);
  writeFile(path("text.ply"), "not a cloud\n");
  EXPECT_THROW(file("text.ply").read(*units_), UserError);
  EXPECT_THROW(file("absent/c.ply").write(list, *units_), UserError);
}

TEST_F(Corrections, KeepPlacesFarFromTheOrigin) {
  SceneInput far = input();
  far.offset = {431'000.0, 5'737'000.0, 0.0};
  CorrectionList list;
  list.add({100, 0.0F, SceneClass::Vehicle});
  const CorrectionFile written(path("far.ply"), files(), far, kSuperpixel);
  written.write(list, *units_);
  EXPECT_EQ(written.read(*units_).active(), list.active());
  const SceneInput read = readScene(findScenes({path("far.ply")}).front());
  for (std::size_t i = 0; i < read.scene.points.size(); ++i) {
    const Eigen::Vector3d place = read.scene.points[i].cast<double>() + read.offset,
                          expected = far.scene.points[i].cast<double>() + far.offset;
    EXPECT_LT((place - expected).norm(), 1e-3) << i;
  }
}

TEST_F(Corrections, TwentyRaiseTheF1AndApplyGivesTheSameAnswers) {
  CorrectionList list;
  const double before = meanF1(teacher_->answer());
  const SceneLabels answer = teach(20, list);
  EXPECT_GT(meanF1(answer), before + 0.2) << before;
  file("yard_corrections.ply").write(list, *units_);
  ASSERT_EQ(testing::runProgram({"labels", "apply", folder_->file("m"), folder_->file("yard_points.csv"), "-o",
                                 path("out"), "--corrections", path("yard_corrections.ply"), "--formats", "csv"}),
            0);
  const auto table = urban_nav_core::CsvTable::read(path("out/yard_labels.csv"));
  ASSERT_EQ(table.rows(), truth().size());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    EXPECT_EQ(table.integer(i, table.column("label")), static_cast<int>(answer.labels[i])) << i;
    EXPECT_NEAR(table.number(i, table.column("probability")), static_cast<double>(answer.probability(i)), 1e-5) << i;
    EXPECT_EQ(table.integer(i, table.column("unsure")), answer.unsure[i]) << i;
  }
}

TEST_F(Corrections, TrainAndApplyGiveTheAnswersOfUncorrectedPoints) {
  CorrectionList list;
  const SceneLabels answer = teach(5, list);
  file("yard_corrections.ply").write(list, *units_);
  ASSERT_EQ(testing::runProgram({"labels", "train", "--add", folder_->file("m"), "--corrections",
                                 path("yard_corrections.ply"), "-o", path("taught")}),
            0);
  const SceneLabels applied =
      scene_labeler::labelScene(readLabelModel(path("taught")).model, teacher_->scene(), kSuperpixel);
  const std::vector<SceneClass> corrected = list.labels(*units_);
  for (std::size_t i = 0; i < corrected.size(); ++i)
    if (corrected[i] == SceneClass::None) {
      EXPECT_EQ(applied.labels[i], answer.labels[i]) << i;
    } else {
      EXPECT_EQ(answer.labels[i], corrected[i]) << i;
      EXPECT_EQ(answer.unsure[i], 0) << i;
    }
}

TEST_F(Corrections, WithoutCorrectionsTheModelAnswers) {
  const std::vector<SceneClass> none(truth().size(), SceneClass::None);
  EXPECT_EQ(teacher_->answer(none).labels, teacher_->answer().labels);
  EXPECT_EQ(teacher_->answer(none).probabilities, teacher_->answer().probabilities);
  scene_labeler::LabelModel without = teacher_->base();
  without.samples = {};
  EXPECT_THROW(SceneTeacher(without, "m", input().scene, {}), UserError);
}

TEST_F(Corrections, SuggestionsAreOpenUnitsByTheirWorth) {
  const std::vector<SceneClass> none(truth().size(), SceneClass::None);
  const auto suggested = suggestCorrections(*units_, *kinds_, teacher_->answer(), {}, none, 10);
  ASSERT_EQ(suggested.size(), 10U);
  std::set<std::uint32_t> kinds;
  for (std::size_t i = 0; i < suggested.size(); ++i) {
    const TeachSuggestion& one = suggested[i];
    if (i > 0) {
      EXPECT_GE(suggested[i - 1].worth, one.worth);
    }
    EXPECT_TRUE(kinds.insert(kinds_->kind(units_->unit(one.point))).second) << "one of each kind";
    EXPECT_LE(one.worth, one.area);
    EXPECT_EQ(one.label, teacher_->answer().labels[one.point]);
    EXPECT_NE(one.label, one.second);
  }
  // A corrected unit is not suggested again, and others like it are worth at most half.
  const LabelCorrection first{suggested[0].point, 0.0F, SceneClass::Vehicle};
  CorrectionList list;
  list.add(first);
  const auto after = suggestCorrections(*units_, *kinds_, teacher_->answer(), list.active(), list.labels(*units_), 100);
  for (const TeachSuggestion& one : after) {
    EXPECT_NE(units_->unit(one.point), units_->unit(first.point));
    if (kinds_->kind(units_->unit(one.point)) == kinds_->kind(units_->unit(first.point))) {
      EXPECT_LE(one.worth, 0.5 * suggested[0].worth);
    }
  }
}

TEST_F(Corrections, SuggestionsFollowAreaTimesUncertainty) {
  // With answers that are certain everywhere but on one car, that is where a correction is worth most.
  SceneLabels answer = teacher_->answer();
  const std::size_t classes = answer.classes.size();
  for (std::size_t i = 0; i < truth().size(); ++i) {
    const bool is_open = i >= 2400 && i < 2900;
    for (std::size_t k = 0; k < classes; ++k) answer.probabilities[i * classes + k] = k == 0 ? 1.0F : 0.0F;
    if (is_open) answer.probabilities[i * classes] = 1.0F - (answer.probabilities[i * classes + 1] = 0.4F);
    answer.unsure[i] = 0;
  }
  const std::vector<SceneClass> none(truth().size(), SceneClass::None);
  const auto suggested = suggestCorrections(*units_, *kinds_, answer, {}, none, 100);
  double worth = 0.0, expected = 0.0;
  for (const TeachSuggestion& one : suggested) worth += one.worth;
  for (std::uint32_t unit = 0; unit < units_->size(); ++unit)
    if (const std::uint32_t point = units_->middle(unit); point >= 2400 && point < 2900)
      expected += 0.4 * static_cast<double>(units_->area(unit));
  EXPECT_NEAR(worth, expected, 1e-3 * expected + 1e-6);
}

}  // namespace
}  // namespace urban_nav
