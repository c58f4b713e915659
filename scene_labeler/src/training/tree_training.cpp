// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/training/tree_training.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "training/tree_builder.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

constexpr float kLargestAddedLeaf = 0.5F;  // as the largest step for rare classes in Chen and Guestrin's library

std::vector<double> weightedShares(const CodedSamples& samples) {
  std::vector<double> shares(samples.classes, 1e-6);
  double total = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    shares[samples.labels[i]] += static_cast<double>(samples.weights[i]);
    total += static_cast<double>(samples.weights[i]);
  }
  for (double& share : shares) share /= std::max(total, 1e-6);
  return shares;
}

/// Computes probabilities of the classes.
void softmax(const float* scores, std::size_t classes, float* probabilities) {
  const float highest = *std::max_element(scores, scores + classes);
  float sum = 0.0F;
  for (std::size_t k = 0; k < classes; ++k) sum += probabilities[k] = std::exp(scores[k] - highest);
  for (std::size_t k = 0; k < classes; ++k) probabilities[k] /= sum;
}

/// Returns the target probability of each sample and class: 1 for its label, or the present one for anchors.
std::vector<float> learntProbabilities(const CodedSamples& samples, const std::vector<float>& scores) {
  const std::size_t classes = samples.classes;
  std::vector<float> targets(samples.size() * classes, 0.0F);
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (samples.is_anchor.empty() || samples.is_anchor[i] == 0) targets[i * classes + samples.labels[i]] = 1.0F;
    else softmax(scores.data() + i * classes, classes, targets.data() + i * classes);
  return targets;
}

/// Computes first and second derivatives of the deviance at these scores.
void deviance(const CodedSamples& samples, const std::vector<float>& targets, const std::vector<float>& scores,
              Derivatives& derivatives) {
  const std::size_t classes = samples.classes;
  urban_nav_core::forEach(samples.size(), 1024, [&](std::size_t i) {
    const float* score = scores.data() + i * classes;
    float* out = derivatives.data() + i * 2 * classes;
    softmax(score, classes, out);
    for (std::size_t k = 0; k < classes; ++k) {
      const float p = out[k];
      out[k] = samples.weights[i] * (p - targets[i * classes + k]);
      out[classes + k] = samples.weights[i] * std::max(p * (1.0F - p), 1e-6F);
    }
  });
}

std::vector<std::uint32_t> drawWithout(std::size_t count, double share, std::mt19937_64& random) {
  std::vector<std::uint32_t> drawn;
  const auto limit = static_cast<std::uint64_t>(share * 65536.0);
  for (std::uint32_t i = 0; i < count; ++i)
    if (random() % 65536 < limit) drawn.push_back(i);
  if (drawn.empty())
    for (std::uint32_t i = 0; i < count; ++i) drawn.push_back(i);
  return drawn;
}

std::vector<std::uint32_t> drawWith(std::size_t count, double share, std::mt19937_64& random) {
  std::vector<std::uint32_t> drawn(
      std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(count))));
  for (std::uint32_t& i : drawn) i = static_cast<std::uint32_t>(random() % count);
  std::sort(drawn.begin(), drawn.end());
  return drawn;
}

}  // namespace

namespace {

/// Adds trees to an ensemble. `largest_leaf`: limit of their values.
void boost(const CodedSamples& samples, const TreeSettings& settings, float largest_leaf, std::uint64_t seed,
           TreeEnsemble& ensemble) {
  std::mt19937_64 random(seed);
  TreeBuilder builder(samples, settings);
  std::vector<float> scores(samples.size() * samples.classes);
  urban_nav_core::forEach(samples.size(), 256, [&](std::size_t i) {
    ensemble.evaluate(samples.codes.data() + i * samples.features, scores.data() + i * samples.classes);
  });
  const std::vector<float> targets = learntProbabilities(samples, scores);
  Derivatives derivatives(samples.size() * 2 * samples.classes);
  for (std::size_t round = 0; round < settings.trees; ++round) {
    deviance(samples, targets, scores, derivatives);
    const auto drawn = drawWithout(samples.size(), settings.sample_share, random);
    ensemble.trees.push_back(
        builder.build(derivatives, drawn, false, static_cast<float>(settings.learning_rate), random));
    LabelTree& tree = ensemble.trees.back();
    for (float& value : tree.leaves) value = std::clamp(value, -largest_leaf, largest_leaf);
    urban_nav_core::forEach(samples.size(), 1024, [&](std::size_t i) {
      const float* leaf =
          tree.leaves.data() + tree.findLeaf(samples.codes.data() + i * samples.features) * samples.classes;
      for (std::size_t k = 0; k < samples.classes; ++k) scores[i * samples.classes + k] += leaf[k];
    });
  }
}

}  // namespace

TreeEnsemble trainBoosted(const CodedSamples& samples, const TreeSettings& settings, std::uint64_t seed) {
  TreeEnsemble ensemble;
  for (const double share : weightedShares(samples)) ensemble.base.push_back(static_cast<float>(std::log(share)));
  boost(samples, settings, std::numeric_limits<float>::max(), seed, ensemble);
  return ensemble;
}

TreeEnsemble continueBoosted(TreeEnsemble ensemble, const CodedSamples& samples, const TreeSettings& settings,
                             std::uint64_t seed) {
  boost(samples, settings, kLargestAddedLeaf, seed, ensemble);
  return ensemble;
}

TreeEnsemble trainForest(const CodedSamples& samples, const TreeSettings& settings, std::uint64_t seed) {
  TreeEnsemble ensemble;
  const std::vector<double> shares = weightedShares(samples);
  for (const double share : shares) ensemble.base.push_back(static_cast<float>(share));
  Derivatives derivatives(samples.size() * 2 * samples.classes);
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t k = 0; k < samples.classes; ++k) {
      float* out = derivatives.data() + i * 2 * samples.classes;
      out[k] = samples.weights[i] * (ensemble.base[k] - (samples.labels[i] == k ? 1.0F : 0.0F));
      out[samples.classes + k] = samples.weights[i];
    }
  std::mt19937_64 random(seed);
  TreeBuilder builder(samples, settings);
  for (std::size_t i = 0; i < settings.trees; ++i)
    ensemble.trees.push_back(builder.build(derivatives, drawWith(samples.size(), settings.sample_share, random), true,
                                           1.0F / static_cast<float>(settings.trees), random));
  return ensemble;
}

}  // namespace scene_labeler
