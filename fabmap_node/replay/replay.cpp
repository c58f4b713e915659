// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/replay/replay.hpp"

#include <algorithm>
#include <cmath>

#include "fabmap_node/model/likelihood.hpp"
#include "fabmap_node/places/place_index.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {

using urban_nav_core::UserError;

namespace {

// Constants of openFABMAP: detector, prior of a new place, forward bias of its motion model, and the share of the
// result that is not smoothed towards a uniform distribution.
constexpr double kDetection = 0.39, kFalseAlarm = 0.01;
constexpr double kNewPlacePrior = 0.9, kForwardBias = 0.5;
constexpr double kUnsmoothed = 0.99;

Detector replayDetector(ReplayModel model) {
  return {kDetection, model == ReplayModel::ChowLiuPzgne001 ? kFalseAlarm : 0.0};
}

double logMeanExp(const std::vector<double>& logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - top);
  return top + std::log(sum / static_cast<double>(logs.size()));
}

/// Adds the log prior that openFABMAP derives from the last posterior: mass moves to the neighbouring place. Entry 0 is
/// the new place; the latest place has no prior, and none has one while the posterior has at most two entries.
void addMotionPrior(const std::vector<double>& posterior, std::vector<double>& logs) {
  logs[0] += std::log(kNewPlacePrior);
  const std::size_t known = posterior.size();
  if (known <= 2) return;
  for (std::size_t i = 1; i < known; ++i) {
    // At both ends the missing neighbour is replaced by the entry itself.
    const double before = posterior[i == 1 ? i : i - 1], after = posterior[i + 1 == known ? i : i + 1];
    logs[i] += std::log((2.0 * (1.0 - kForwardBias) * before + posterior[i] + 2.0 * kForwardBias * after) / 3.0);
  }
}

std::vector<double> normalisedPosterior(std::vector<double> logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (double& value : logs) sum += value = std::exp(value - top);
  for (double& value : logs) value = kUnsmoothed * value / sum + (1.0 - kUnsmoothed) / static_cast<double>(logs.size());
  return logs;
}

}  // namespace

const std::vector<std::string>& replayModelNames() {
  static const std::vector<std::string> names = {"chowliu", "naive", "chowliu_pzgne001", "fabmap2_sampled",
                                                 "chowliu_motion"};
  return names;
}

ReplayModel replayModelFromName(const std::string& name) {
  const std::vector<std::string>& names = replayModelNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<ReplayModel>(found - names.begin());
  std::string allowed;
  for (const std::string& known : names) allowed += (allowed.empty() ? "" : ", ") + known;
  throw UserError("--model", name, allowed);
}

void replay(const WordSets& input, const ChowLiuTree& tree, ReplayModel model,
            const std::function<void(const ReplayRow&)>& row) {
  if (input.vocabulary_size != tree.size())
    throw UserError("tree", std::to_string(tree.size()) + " words",
                    std::to_string(input.vocabulary_size) + ", as the bags of words have");
  const LikelihoodTable table(tree, replayDetector(model),
                              model == ReplayModel::Naive ? Dependence::Naive : Dependence::ChowLiu);
  PlaceIndex samples(table), places(table);
  if (model == ReplayModel::Fabmap2Sampled)
    for (const WordSet& observation : input.observations) samples.add(observation);
  std::vector<double> at_places, at_samples, posterior;
  for (std::size_t query = 0; query < input.observations.size(); ++query) {
    const WordSet& observation = input.observations[query];
    places.logLikelihoods(observation, at_places);
    std::vector<double> logs(1 + at_places.size());
    if (model == ReplayModel::Fabmap2Sampled) {
      samples.logLikelihoods(observation, at_samples);
      logs[0] = logMeanExp(at_samples);
    } else {
      logs[0] = logLikelihoodUnknown(table, observation);
    }
    std::copy(at_places.begin(), at_places.end(), logs.begin() + 1);
    std::vector<double> weighted = logs;
    if (model == ReplayModel::ChowLiuMotion) addMotionPrior(posterior, weighted);
    posterior = normalisedPosterior(std::move(weighted));
    for (std::size_t i = 0; i < logs.size(); ++i) row({query, static_cast<std::int64_t>(i) - 1, logs[i], posterior[i]});
    places.add(observation);
  }
}

}  // namespace fabmap_node
