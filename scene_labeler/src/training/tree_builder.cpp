// SPDX-License-Identifier: BSD-3-Clause
#include "training/tree_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

constexpr std::size_t kCodes = FeatureBins::kCodeCount;
constexpr float kLeastEntry = 1e-3F;  // weight in a histogram; smaller values are rounding of a difference

}  // namespace

TreeBuilder::TreeBuilder(const CodedSamples& samples, const TreeSettings& settings)
    : samples_(samples), settings_(settings), width_(2 * samples.classes + 1), columns_(samples.codes.size()) {
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t f = 0; f < samples.features; ++f)
      columns_[f * samples.size() + i] = samples.codes[i * samples.features + f];
}

std::vector<float> TreeBuilder::makeHistogram(const std::vector<std::uint32_t>& samples) const {
  std::vector<float> histogram(samples_.features * kCodes * width_, 0.0F);
  const std::size_t values = width_ - 1;
  urban_nav_core::forEach(tree_features_.size(), 4, [&](std::size_t number) {
    const std::size_t f = tree_features_[number];
    const std::uint8_t* column = columns_.data() + f * samples_.size();
    float* entries = histogram.data() + f * kCodes * width_;
    for (const std::uint32_t i : samples) {
      float* entry = entries + column[i] * width_;
      const float* derivatives = derivatives_->data() + i * values;
      for (std::size_t k = 0; k < values; ++k) entry[k] += derivatives[k];
      entry[values] += samples_.weights[i];
    }
  });
  return histogram;
}

std::vector<double> TreeBuilder::sumHistogram(const std::vector<float>& histogram) const {
  std::vector<double> total(width_, 0.0);
  const float* entries = histogram.data() + tree_features_.front() * kCodes * width_;
  for (std::size_t code = 0; code < kCodes; ++code)
    for (std::size_t k = 0; k < width_; ++k) total[k] += static_cast<double>(entries[code * width_ + k]);
  return total;
}

double TreeBuilder::scoreTotal(const double* total) const {
  double score = 0.0;
  for (std::size_t k = 0; k < samples_.classes; ++k)
    score += total[k] * total[k] / (std::max(total[samples_.classes + k], 0.0) + settings_.regularisation);
  return score;
}

TreeBuilder::Split TreeBuilder::bestSplitBy(const Leaf& leaf, std::uint8_t feature) const {
  Split best;
  const double whole = scoreTotal(leaf.total.data());
  const float* entries = leaf.histogram.data() + feature * kCodes * width_;
  const std::size_t weight = width_ - 1;
  std::vector<double> left(width_), right(width_);
  const bool has_missing = entries[weight] > kLeastEntry;
  for (const bool missing_right : {false, true}) {
    if (missing_right && !has_missing) continue;
    for (std::size_t k = 0; k < width_; ++k) left[k] = missing_right ? 0.0 : static_cast<double>(entries[k]);
    for (std::size_t code = 1; code + 1 < kCodes; ++code) {
      const float* entry = entries + code * width_;
      if (!(entry[weight] > kLeastEntry)) continue;  // same split as the previous threshold
      for (std::size_t k = 0; k < width_; ++k) left[k] += static_cast<double>(entry[k]);
      if (left[weight] < settings_.least_weight) continue;
      if (leaf.total[weight] - left[weight] < settings_.least_weight) break;
      for (std::size_t k = 0; k < width_; ++k) right[k] = leaf.total[k] - left[k];
      const double gain = scoreTotal(left.data()) + scoreTotal(right.data()) - whole;
      if (gain > best.gain) best = {gain, feature, static_cast<std::uint8_t>(code), missing_right};
    }
  }
  return best;
}

TreeBuilder::Split TreeBuilder::bestSplit(const Leaf& leaf, const std::vector<std::uint8_t>& features) const {
  std::vector<Split> splits(features.size());
  urban_nav_core::forEach(features.size(), 4, [&](std::size_t i) { splits[i] = bestSplitBy(leaf, features[i]); });
  Split best;
  for (const Split& split : splits)
    if (split.gain > best.gain) best = split;
  return best;
}

void TreeBuilder::divide(Leaf& leaf, Leaf& other) const {
  const std::uint8_t* column = columns_.data() + leaf.split.feature * samples_.size();
  std::vector<std::uint32_t> left;
  for (const std::uint32_t i : leaf.samples) {
    const bool goes_right = column[i] == 0 ? leaf.split.missing_right : column[i] > leaf.split.threshold;
    (goes_right ? other.samples : left).push_back(i);
  }
  leaf.samples = std::move(left);
  // Computes the histogram of the smaller part; that of the larger one is the difference.
  const bool counts_left = leaf.samples.size() <= other.samples.size();
  std::vector<float> counted = makeHistogram(counts_left ? leaf.samples : other.samples);
  std::vector<float> rest = std::move(leaf.histogram);
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= counted[i];
  leaf.histogram = counts_left ? std::move(counted) : std::move(rest);
  other.histogram = counts_left ? std::move(rest) : std::move(counted);
  leaf.total = sumHistogram(leaf.histogram);
  other.total = sumHistogram(other.histogram);
}

std::vector<std::uint8_t> TreeBuilder::drawFeatures(std::mt19937_64& random) const {
  std::vector<std::uint8_t> all(samples_.features);
  std::iota(all.begin(), all.end(), std::uint8_t{0});
  const auto wanted = static_cast<std::size_t>(std::ceil(settings_.feature_share * static_cast<double>(all.size())));
  for (std::size_t i = 0; i < wanted; ++i) std::swap(all[i], all[i + random() % (all.size() - i)]);
  all.resize(std::max<std::size_t>(wanted, 1));
  std::sort(all.begin(), all.end());
  return all;
}

LabelTree TreeBuilder::build(const Derivatives& derivatives, const std::vector<std::uint32_t>& drawn,
                             bool draws_per_node, float step, std::mt19937_64& random) {
  derivatives_ = &derivatives;
  tree_features_.resize(samples_.features);
  std::iota(tree_features_.begin(), tree_features_.end(), std::uint8_t{0});
  if (!draws_per_node) tree_features_ = drawFeatures(random);
  const auto featuresOfNode = [&] { return draws_per_node ? drawFeatures(random) : tree_features_; };
  LabelTree tree;
  std::vector<Leaf> leaves(1);
  leaves[0].samples = drawn;
  leaves[0].histogram = makeHistogram(drawn);
  leaves[0].total = sumHistogram(leaves[0].histogram);
  leaves[0].split = bestSplit(leaves[0], featuresOfNode());
  leaves.reserve(settings_.leaves);
  while (leaves.size() < settings_.leaves) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < leaves.size(); ++i)
      if (leaves[i].split.gain > leaves[best].split.gain) best = i;
    if (!(leaves[best].split.gain > 1e-9)) break;
    const auto node = static_cast<std::int16_t>(tree.nodes.size());
    const Split split = leaves[best].split;
    tree.nodes.push_back({split.feature, split.threshold, split.missing_right, -1, -1});
    if (leaves[best].parent >= 0) {
      LabelTree::Node& parent = tree.nodes[static_cast<std::size_t>(leaves[best].parent)];
      (leaves[best].is_right ? parent.right : parent.left) = node;
    }
    leaves.emplace_back();
    Leaf& left = leaves[best];
    Leaf& right = leaves.back();
    divide(left, right);
    left.parent = right.parent = node;
    left.is_right = false;
    right.is_right = true;
    left.split = bestSplit(left, featuresOfNode());
    right.split = bestSplit(right, featuresOfNode());
  }
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    for (std::size_t k = 0; k < samples_.classes; ++k)
      tree.leaves.push_back(
          step * static_cast<float>(-leaves[i].total[k] /
                                    (std::max(leaves[i].total[samples_.classes + k], 0.0) + settings_.regularisation)));
    if (leaves[i].parent < 0) continue;
    LabelTree::Node& parent = tree.nodes[static_cast<std::size_t>(leaves[i].parent)];
    (leaves[i].is_right ? parent.right : parent.left) = static_cast<std::int16_t>(-1 - static_cast<int>(i));
  }
  return tree;
}

}  // namespace scene_labeler
