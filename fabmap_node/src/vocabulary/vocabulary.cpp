// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/vocabulary/vocabulary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace fabmap_node {
namespace {

constexpr std::size_t kUngrouped = 64;  // vocabularies of at most this size are searched exhaustively
constexpr std::size_t kVisitedGroups = 8;
constexpr int kGroupingIterations = 4;

using Column = Eigen::Matrix<float, static_cast<int>(kDescriptorBytes), 1>;

Column makeColumn(const ByteDescriptor& descriptor) {
  return Eigen::Map<const Eigen::Matrix<std::uint8_t, static_cast<int>(kDescriptorBytes), 1>>(descriptor.data())
      .cast<float>();
}

}  // namespace

Vocabulary::Vocabulary(std::vector<ByteDescriptor> centres) : centres_(std::move(centres)) { group(); }

void Vocabulary::group() {
  if (centres_.empty()) return;
  const std::size_t words = centres_.size();
  const std::size_t count =
      words <= kUngrouped ? 1 : static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(words))));
  Columns all(static_cast<Eigen::Index>(kDescriptorBytes), static_cast<Eigen::Index>(words));
  for (std::size_t i = 0; i < words; ++i) all.col(static_cast<Eigen::Index>(i)) = makeColumn(centres_[i]);
  coarse_.resize(Eigen::NoChange, static_cast<Eigen::Index>(count));
  for (std::size_t g = 0; g < count; ++g)
    coarse_.col(static_cast<Eigen::Index>(g)) = all.col(static_cast<Eigen::Index>(g * words / count));
  std::vector<Eigen::Index> member(words, 0);
  for (int iteration = 0; iteration < kGroupingIterations; ++iteration) {
    coarse_half_norm_ = 0.5F * coarse_.colwise().squaredNorm().transpose();
    for (std::size_t i = 0; i < words; ++i)
      (coarse_.transpose() * all.col(static_cast<Eigen::Index>(i)) - coarse_half_norm_).maxCoeff(&member[i]);
    if (iteration + 1 == kGroupingIterations) break;
    Columns sum = Columns::Zero(coarse_.rows(), coarse_.cols());
    std::vector<float> members(count, 0.0F);
    for (std::size_t i = 0; i < words; ++i) {
      sum.col(member[i]) += all.col(static_cast<Eigen::Index>(i));
      members[static_cast<std::size_t>(member[i])] += 1.0F;
    }
    // Integers, so that sums of products are exact and independent of the order of summation.
    for (std::size_t g = 0; g < count; ++g)
      if (members[g] > 0.0F)
        coarse_.col(static_cast<Eigen::Index>(g)) =
            (sum.col(static_cast<Eigen::Index>(g)) / members[g]).array().round();
  }
  groups_.assign(count, {});
  for (std::size_t i = 0; i < words; ++i)
    groups_[static_cast<std::size_t>(member[i])].words.push_back(static_cast<Word>(i));
  for (CentreGroup& group : groups_) {
    group.centres.resize(Eigen::NoChange, static_cast<Eigen::Index>(group.words.size()));
    for (std::size_t i = 0; i < group.words.size(); ++i)
      group.centres.col(static_cast<Eigen::Index>(i)) = all.col(static_cast<Eigen::Index>(group.words[i]));
    group.half_norm = 0.5F * group.centres.colwise().squaredNorm().transpose();
  }
}

Word Vocabulary::quantise(const ByteDescriptor& descriptor) const {
  const Column asked = makeColumn(descriptor);
  const Eigen::VectorXf score = coarse_.transpose() * asked - coarse_half_norm_;
  std::vector<Eigen::Index> order(groups_.size());
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const std::size_t visited = std::min(kVisitedGroups, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(visited), order.end(),
      [&score](Eigen::Index a, Eigen::Index b) { return score(a) != score(b) ? score(a) > score(b) : a < b; });
  Word best = 0;
  float best_score = -std::numeric_limits<float>::infinity();
  Eigen::VectorXf scores;
  for (std::size_t k = 0; k < visited; ++k) {
    const CentreGroup& group = groups_[static_cast<std::size_t>(order[k])];
    if (group.words.empty()) continue;
    scores.noalias() = group.centres.transpose() * asked - group.half_norm;
    Eigen::Index at = 0;
    const float top = scores.maxCoeff(&at);
    const Word word = group.words[static_cast<std::size_t>(at)];
    if (top > best_score || (top == best_score && word < best)) {
      best_score = top;
      best = word;
    }
  }
  return best;
}

Word Vocabulary::quantiseExactly(const ByteDescriptor& descriptor) const {
  Word best = 0;
  long nearest = std::numeric_limits<long>::max();
  for (std::size_t w = 0; w < centres_.size(); ++w) {
    long distance = 0;
    for (std::size_t i = 0; i < kDescriptorBytes; ++i) {
      const int d = static_cast<int>(descriptor[i]) - static_cast<int>(centres_[w][i]);
      distance += d * d;
    }
    if (distance < nearest) {
      nearest = distance;
      best = static_cast<Word>(w);
    }
  }
  return best;
}

WordSet Vocabulary::words(const PlaceObservation& observation) const {
  WordSet set;
  set.reserve(observation.features.size());
  for (const PlaceFeature& feature : observation.features) set.push_back(quantise(feature.descriptor));
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
  return set;
}

}  // namespace fabmap_node
