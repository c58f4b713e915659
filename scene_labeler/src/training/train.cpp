// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/training/train.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene_labeler/labelling/superpixels.hpp"
#include "scene_labeler/training/tree_training.hpp"
#include "training/patch_fusion.hpp"
#include "training/sure_validation.hpp"
#include "training/svm_training.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace scene_labeler {
namespace {

constexpr std::size_t kMostFolds = 5;
constexpr std::size_t kAddedTrees = 60;
constexpr float kLeastNewScore = -7.0F;  // log score of a class unknown to the base, before trees are added
constexpr float kLeastSamples = 10.0F;   // sum of weights: a class with less is not trained
constexpr std::size_t kMostModelBytes = 980'000, kLeastSampleBytes = 200'000, kMostSampleBytes = 840'000;

/// Settings tried by cross-validation.
struct TrialSetting {
  TreeSettings trees;
  SvmSettings svm;
  std::vector<std::pair<std::string, double>> values;
};

std::vector<TrialSetting> makeTrials(ClassifierKind kind) {
  std::vector<TrialSetting> trials;
  if (kind == ClassifierKind::Svm) {
    for (const double c : {1.0, 10.0})
      for (const double gamma : {0.3, 1.0}) trials.push_back({{}, {c, gamma}, {{"c", c}, {"gamma", gamma}}});
    return trials;
  }
  for (const double leaves :
       kind == ClassifierKind::Boosted ? std::vector<double>{8.0, 24.0} : std::vector<double>{64.0, 128.0}) {
    TreeSettings settings;
    settings.leaves = static_cast<std::size_t>(leaves);
    if (kind == ClassifierKind::Forest) {
      settings.trees = 100;
      settings.regularisation = 1e-3;
      settings.least_weight = 3.0;
      settings.feature_share = 0.15;
      settings.sample_share = 1.0;
    }
    trials.push_back({settings, {}, {{"leaves", leaves}, {"trees", static_cast<double>(settings.trees)}}});
  }
  return trials;
}

/// Samples of all folds, each with the group of folds that cross-validation holds out together.
struct SamplePool {
  std::size_t columns = 0;
  std::vector<SceneClass> classes;
  std::vector<float> values;
  std::vector<std::uint8_t> labels;
  std::vector<float> weights;
  std::vector<std::size_t> groups;
  std::vector<std::uint16_t> folds;  // index among the folds
};

constexpr std::size_t kNoGroup = static_cast<std::size_t>(-1);  // holds out nothing

std::uint8_t positionIn(const std::vector<SceneClass>& classes, SceneClass wanted) {
  return static_cast<std::uint8_t>(std::find(classes.begin(), classes.end(), wanted) - classes.begin());
}

/// Merges all kinds of wall into one class if some fold does not distinguish them.
void foldWalls(std::vector<TrainingFold>& folds) {
  bool has_wall = false;
  for (const TrainingFold& fold : folds)
    for (const SceneClass label : fold.samples.labels) has_wall = has_wall || label == SceneClass::Wall;
  if (!has_wall) return;
  for (TrainingFold& fold : folds)
    for (std::vector<SceneClass>* labels : {&fold.samples.labels, &fold.held_out.labels})
      std::transform(labels->begin(), labels->end(), labels->begin(), withOneWall);
}

std::vector<SceneClass> presentClasses(const std::vector<TrainingFold>& folds) {
  std::vector<float> counts(kClassCount, 0.0F);
  for (const TrainingFold& fold : folds)
    for (std::size_t i = 0; i < fold.samples.labels.size(); ++i)
      counts[toIndex(fold.samples.labels[i])] += fold.samples.weights[i];
  std::vector<SceneClass> classes;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] >= kLeastSamples) classes.push_back(static_cast<SceneClass>(i));
  if (classes.size() < 2)
    throw urban_nav_core::DataError(
        "", classes.empty() ? "no labelled points" : std::string("points of ") + toString(classes[0]) + " alone",
        "labels of two classes or more");
  return classes;
}

SamplePool makePool(const std::vector<TrainingFold>& folds, const TrainingOptions& options) {
  SamplePool pool;
  pool.columns = featureNames(options.features).size();
  pool.classes = presentClasses(folds);
  std::vector<std::size_t> totals(kClassCount, 0);
  for (const TrainingFold& fold : folds)
    for (const SceneClass label : fold.samples.labels) ++totals[toIndex(label)];
  std::vector<std::size_t> seen(kClassCount, 0);
  for (std::size_t f = 0; f < folds.size(); ++f) {
    const FoldRows& rows = folds[f].samples;
    for (std::size_t i = 0; i < rows.labels.size(); ++i) {
      const std::size_t of_class = toIndex(rows.labels[i]), total = totals[of_class], number = seen[of_class]++;
      const std::size_t wanted = std::min(total, options.samples_per_class);
      if ((number + 1) * wanted / total == number * wanted / total) continue;  // evenly subsampled
      const std::uint8_t label = positionIn(pool.classes, rows.labels[i]);
      if (label >= pool.classes.size()) continue;
      pool.values.insert(pool.values.end(), rows.values.begin() + static_cast<std::ptrdiff_t>(i * pool.columns),
                         rows.values.begin() + static_cast<std::ptrdiff_t>((i + 1) * pool.columns));
      pool.labels.push_back(label);
      pool.weights.push_back(rows.weights[i]);
      pool.groups.push_back(f % kMostFolds);
      pool.folds.push_back(static_cast<std::uint16_t>(f));
    }
  }
  return pool;
}

/// Gives every class the same weight, so that rare ones are learnt; calibration restores the frequencies.
std::vector<float> balancedWeights(const std::vector<std::uint8_t>& labels, std::vector<float> weights,
                                   std::size_t classes) {
  std::vector<double> totals(classes, 0.0);
  double all = 0.0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    totals[labels[i]] += static_cast<double>(weights[i]);
    all += static_cast<double>(weights[i]);
  }
  for (std::size_t i = 0; i < labels.size(); ++i)
    weights[i] *= static_cast<float>(std::sqrt(all / static_cast<double>(classes) / totals[labels[i]]));
  return weights;
}

/// Returns the samples outside one group, in codes of the model's bins, with balanced weights.
CodedSamples codeSamples(const SamplePool& pool, std::size_t left_out, const FeatureBins& bins) {
  CodedSamples coded;
  coded.features = pool.columns;
  coded.classes = pool.classes.size();
  for (std::size_t i = 0; i < pool.labels.size(); ++i) {
    if (pool.groups[i] == left_out) continue;
    for (std::size_t column = 0; column < pool.columns; ++column)
      coded.codes.push_back(bins.code(column, pool.values[i * pool.columns + column]));
    coded.labels.push_back(pool.labels[i]);
    coded.weights.push_back(pool.weights[i]);
    coded.is_anchor.push_back(pool.weights[i] > 1.0F ? 0 : 1);  // corrections have a larger weight
  }
  coded.weights = balancedWeights(coded.labels, coded.weights, coded.classes);
  return coded;
}

/// Fits the classifier of a model to the samples outside one group.
void fitClassifier(const SamplePool& pool, std::size_t left_out, const TrialSetting& trial, std::uint64_t seed,
                   LabelModel& model) {
  if (model.kind != ClassifierKind::Svm) {
    CodedSamples coded = codeSamples(pool, left_out, model.bins);
    coded.is_anchor.clear();
    model.trees = model.kind == ClassifierKind::Boosted ? trainBoosted(coded, trial.trees, seed)
                                                        : trainForest(coded, trial.trees, seed);
    return;
  }
  ValueSamples plain;
  plain.features = pool.columns;
  plain.classes = pool.classes.size();
  for (std::size_t i = 0; i < pool.labels.size(); ++i) {
    if (pool.groups[i] == left_out) continue;
    const float* row = pool.values.data() + i * pool.columns;
    plain.values.insert(plain.values.end(), row, row + pool.columns);
    plain.labels.push_back(pool.labels[i]);
  }
  for (const SceneClass of_class : pool.classes) plain.is_ground.push_back(isKindOfGround(of_class));
  const std::vector<std::string>& names = featureNames(model.features);
  for (const char* name : {"over_ground", model.features == FeatureSet::Paper ? "normal_z" : "normal_z_0.4"})
    plain.ground_columns.push_back(
        static_cast<std::uint8_t>(std::find(names.begin(), names.end(), name) - names.begin()));
  model.svm = trainSvmBank(plain, trial.svm);
}

Calibration identityCalibration(std::size_t classes) { return {1.0, std::vector<float>(classes, 0.0F)}; }

/// Appends the scores of the held-out returns of the folds of a group.
void scoreHeldOut(const std::vector<TrainingFold>& folds, std::size_t group, const LabelModel& model,
                  HeldOutPatches& held_out) {
  const std::size_t classes = model.classes.size(), columns = model.bins.columns();
  held_out.points.classes = classes;
  for (std::size_t f = 0; f < folds.size(); ++f) {
    if (f % kMostFolds != group) continue;
    const FoldRows& rows = folds[f].held_out;
    std::uint32_t first = 0;
    for (const std::uint32_t patch : held_out.patches)
      if (patch != kNoPatch) first = std::max(first, patch + 1);
    std::vector<float> scores(rows.labels.size() * classes);
    urban_nav_core::forEach(rows.labels.size(), 256, [&](std::size_t i) {
      model.logProbabilities(rows.values.data() + i * columns, scores.data() + i * classes);
    });
    for (std::size_t i = 0; i < rows.labels.size(); ++i) {
      const std::uint8_t label = positionIn(model.classes, rows.labels[i]);
      if (label >= classes) continue;
      held_out.points.scores.insert(held_out.points.scores.end(),
                                    scores.begin() + static_cast<std::ptrdiff_t>(i * classes),
                                    scores.begin() + static_cast<std::ptrdiff_t>((i + 1) * classes));
      held_out.points.labels.push_back(label);
      held_out.points.weights.push_back(rows.weights[i]);
      held_out.patches.push_back(rows.patches[i] == kNoPatch ? kNoPatch : first + rows.patches[i]);
      held_out.sites.push_back(static_cast<std::uint16_t>(f));
    }
  }
}

double meanF1(const HeldOutScores& held_out) {
  std::vector<double> hits(held_out.classes, 0.0), stated(held_out.classes, 0.0), true_count(held_out.classes, 0.0);
  for (std::size_t i = 0; i < held_out.size(); ++i) {
    const auto first = held_out.scores.begin() + static_cast<std::ptrdiff_t>(i * held_out.classes);
    const auto answer = static_cast<std::size_t>(
        std::max_element(first, first + static_cast<std::ptrdiff_t>(held_out.classes)) - first);
    stated[answer] += 1.0;
    true_count[held_out.labels[i]] += 1.0;
    if (answer == held_out.labels[i]) hits[answer] += 1.0;
  }
  double sum = 0.0, present = 0.0;
  for (std::size_t k = 0; k < held_out.classes; ++k) {
    if (true_count[k] < 1.0) continue;
    sum += 2.0 * hits[k] / std::max(1.0, stated[k] + true_count[k]);
    present += 1.0;
  }
  return present > 0.0 ? sum / present : 0.0;
}

NoveltyRanges measureRanges(const SamplePool& pool) {
  NoveltyRanges ranges;
  ranges.low_values.resize(pool.columns);
  ranges.high_values.resize(pool.columns);
  urban_nav_core::forEach(pool.columns, 1, [&](std::size_t column) {
    std::vector<float> values;
    for (std::size_t i = 0; i < pool.labels.size(); ++i)
      if (const float value = pool.values[i * pool.columns + column]; !std::isnan(value)) values.push_back(value);
    std::sort(values.begin(), values.end());
    if (values.empty()) return;
    const float low = values[values.size() / 500], high = values[values.size() - 1 - values.size() / 500];
    const float margin = 0.1F * (high - low);
    ranges.low_values[column] = low - margin;
    ranges.high_values[column] = high + margin;
  });
  return ranges;
}

/// Returns the samples for continued training: evenly subsampled per class, as many as the file may hold.
ModelSamples keepSamples(const SamplePool& pool, const std::vector<TrainingFold>& folds, const LabelModel& model) {
  const std::size_t classes = pool.classes.size(), used = printModel(model).size();
  const std::size_t room =
      std::clamp(kMostModelBytes - std::min(used, kMostModelBytes), kLeastSampleBytes, kMostSampleBytes);
  const std::size_t limit = room / (pool.columns + 10) / classes;  // label, weight and place take ten bytes
  ModelSamples kept;
  for (const TrainingFold& fold : folds) kept.folds.push_back(fold.name);
  std::vector<std::size_t> totals(classes, 0), seen(classes, 0);
  const auto isKept = [&](std::size_t i) { return pool.weights[i] >= 1.0F; };  // anchors are the model's own answers
  for (std::size_t i = 0; i < pool.labels.size(); ++i) totals[pool.labels[i]] += isKept(i) ? 1U : 0U;
  for (std::size_t i = 0; i < pool.labels.size(); ++i) {
    if (!isKept(i)) continue;
    const std::size_t total = totals[pool.labels[i]], number = seen[pool.labels[i]]++;
    const std::size_t wanted = std::min(total, limit);
    if ((number + 1) * wanted / total == number * wanted / total) continue;
    for (std::size_t column = 0; column < pool.columns; ++column)
      kept.codes.push_back(model.bins.code(column, pool.values[i * pool.columns + column]));
    kept.labels.push_back(pool.labels[i]);
    kept.weights.push_back(static_cast<std::uint8_t>(std::clamp(pool.weights[i], 1.0F, 255.0F)));
    kept.places.push_back(pool.folds[i]);
  }
  kept.frequencies.assign(classes, 0.0F);
  for (const TrainingFold& fold : folds)
    for (std::size_t i = 0; i < fold.held_out.labels.size(); ++i)
      if (const std::uint8_t label = positionIn(pool.classes, fold.held_out.labels[i]); label < classes)
        kept.frequencies[label] += fold.held_out.weights[i];
  return kept;
}

/// Extends the ranges of features by those of the base model, whose stored samples are coarse.
void keepRanges(const NoveltyRanges& before, NoveltyRanges& ranges) {
  for (std::size_t i = 0; i < ranges.low_values.size() && i < before.low_values.size(); ++i) {
    ranges.low_values[i] = std::min(ranges.low_values[i], before.low_values[i]);
    ranges.high_values[i] = std::max(ranges.high_values[i], before.high_values[i]);
  }
}

/// Returns the values of `before`, one per class of `from`, for the classes of `to`; `absent` for those it lacks.
std::vector<float> forClasses(const std::vector<float>& before, const std::vector<SceneClass>& from,
                              const std::vector<SceneClass>& to, float absent) {
  std::vector<float> values;
  for (const SceneClass of_class : to) {
    const std::uint8_t at = positionIn(from, of_class);
    values.push_back(at < from.size() ? before[at] : absent);
  }
  return values;
}

/// Fits the fusion of patches, or takes it from the base model if no return has a patch.
void fitOrKeepFusion(const HeldOutPatches& held_out, const LabelModel* base, LabelModel& model) {
  const bool has_patches =
      std::any_of(held_out.patches.begin(), held_out.patches.end(), [](std::uint32_t p) { return p != kNoPatch; });
  if (has_patches || !base) return fitPatchFusion(held_out, model);
  model.correlation = base->correlation;
  model.patch_calibration = base->patch_calibration;
  model.patch_calibration.bias = forClasses(base->patch_calibration.bias, base->classes, model.classes, 0.0F);
}

/// Returns an ensemble extended by classes with the score kLeastNewScore.
TreeEnsemble widenEnsemble(TreeEnsemble ensemble, const std::vector<SceneClass>& from,
                           const std::vector<SceneClass>& to) {
  ensemble.base = forClasses(ensemble.base, from, to, kLeastNewScore);
  for (LabelTree& tree : ensemble.trees) {
    std::vector<float> leaves;
    for (std::size_t leaf = 0; leaf < tree.leaves.size(); leaf += from.size()) {
      const auto begin = tree.leaves.begin() + static_cast<std::ptrdiff_t>(leaf);
      const std::vector<float> wide =
          forClasses({begin, begin + static_cast<std::ptrdiff_t>(from.size())}, from, to, 0.0F);
      leaves.insert(leaves.end(), wide.begin(), wide.end());
    }
    tree.leaves = std::move(leaves);
  }
  return ensemble;
}

/// Adds trees to those of the base. Returns false if that is impossible: another kind, or removed classes.
bool addTrees(const SamplePool& pool, const TrainingOptions& options, LabelModel& model) {
  const LabelModel* base = options.base;
  if (!options.adds_trees || !base || base->kind != ClassifierKind::Boosted || options.kind != base->kind) return false;
  for (const SceneClass before : base->classes)
    if (positionIn(pool.classes, before) == pool.classes.size()) return false;
  model.bins = base->bins;
  TreeSettings settings;
  settings.trees = kAddedTrees;
  model.trees = continueBoosted(widenEnsemble(base->trees, base->classes, pool.classes),
                                codeSamples(pool, kNoGroup, model.bins), settings, options.seed);
  model.calibration = base->calibration;
  model.calibration.bias = forClasses(base->calibration.bias, base->classes, pool.classes, 0.0F);
  model.patch_calibration = base->patch_calibration;
  model.patch_calibration.bias = forClasses(base->patch_calibration.bias, base->classes, pool.classes, 0.0F);
  model.correlation = base->correlation;
  model.sure = base->sure;
  return true;
}

/// Cross-validates all settings; returns the held-out scores of the best one, before calibration.
HeldOutPatches crossValidate(const std::vector<TrainingFold>& folds, const SamplePool& pool,
                             const std::vector<TrialSetting>& trials, std::uint64_t seed, TrainedModel& trained,
                             const std::function<void(double)>& progress) {
  const std::size_t groups = std::min(folds.size(), kMostFolds);
  HeldOutPatches best;
  for (std::size_t t = 0; t < trials.size(); ++t) {
    HeldOutPatches held_out;
    for (std::size_t group = 0; group < groups; ++group) {
      fitClassifier(pool, groups > 1 ? group : kNoGroup, trials[t], seed, trained.model);
      scoreHeldOut(folds, group, trained.model, held_out);
      progress(static_cast<double>(t * groups + group + 1) / static_cast<double>(trials.size() * groups + 1));
    }
    trained.cross_validation.push_back({trials[t].values, meanF1(held_out.points)});
    if (t > 0 && trained.cross_validation[t].f1_mean <= trained.cross_validation[trained.chosen].f1_mean) continue;
    trained.chosen = t;
    best = std::move(held_out);
  }
  return best;
}

/// Trains with the best setting of cross-validation, and calibrates on the held-out folds.
void retrain(const std::vector<TrainingFold>& folds, const SamplePool& pool, const TrainingOptions& options,
             const std::function<void(double)>& progress, TrainedModel& trained) {
  LabelModel& model = trained.model;
  const std::vector<TrialSetting> trials = makeTrials(options.kind);
  HeldOutPatches held_out = crossValidate(folds, pool, trials, options.seed, trained, progress);
  fitClassifier(pool, kNoGroup, trials[trained.chosen], options.seed, model);
  if (held_out.points.size() == 0) return;
  model.calibration = fitCalibration(held_out.points);
  for (std::size_t i = 0; i < held_out.points.size(); ++i)
    model.calibration.apply(held_out.points.scores.data() + i * pool.classes.size());
  fitOrKeepFusion(held_out, options.base, model);
  model.sure = measureSureThresholds(held_out, model);
}

}  // namespace

TrainedModel trainModel(std::vector<TrainingFold> folds, const TrainingOptions& options,
                        const std::function<void(double)>& progress) {
  std::sort(folds.begin(), folds.end(), [](const TrainingFold& a, const TrainingFold& b) { return a.name < b.name; });
  foldWalls(folds);
  const SamplePool pool = makePool(folds, options);
  TrainedModel trained;
  trained.folds = folds.size();
  LabelModel& model = trained.model;
  model.kind = options.kind;
  model.features = options.features;
  model.device = options.device;
  if (options.base) model.precision = options.base->precision;
  model.classes = pool.classes;
  model.bins = FeatureBins(pool.values, pool.columns);
  model.calibration = model.patch_calibration = identityCalibration(pool.classes.size());
  for (const TrainingFold& fold : folds) model.sources.push_back(fold.name);
  if (!addTrees(pool, options, model)) retrain(folds, pool, options, progress, trained);
  model.novelty = measureRanges(pool);
  if (options.base) keepRanges(options.base->novelty, model.novelty);
  model.samples = keepSamples(pool, folds, model);
  model.place_novelty = PlaceNovelty(model.features, model.bins, model.samples);
  std::vector<std::size_t> counts(pool.classes.size(), 0);
  for (const std::uint8_t label : pool.labels) ++counts[label];
  for (std::size_t k = 0; k < counts.size(); ++k) trained.samples.emplace_back(pool.classes[k], counts[k]);
  progress(1.0);
  return trained;
}

}  // namespace scene_labeler
