// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/model/chow_liu_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {

using urban_nav_core::UserError;

namespace {

constexpr std::size_t kProgressEvery = 256;  // words added to the tree

/// Returns a frequency shrunk away from 0 and 1, as in openFABMAP; `total` may be 0.
double smoothedFrequency(std::size_t count, std::size_t total) {
  return total == 0 ? 0.01 : 0.98 * static_cast<double>(count) / static_cast<double>(total) + 0.01;
}

/// Returns, for each word, the observations that contain it, ascending.
std::vector<std::vector<std::uint32_t>> invertObservations(const WordSets& training) {
  std::vector<std::vector<std::uint32_t>> containing(training.vocabulary_size);
  for (std::size_t i = 0; i < training.observations.size(); ++i)
    for (const Word word : training.observations[i]) {
      if (word >= training.vocabulary_size)
        throw UserError("observation " + std::to_string(i), "word " + std::to_string(word),
                        "below the vocabulary's " + std::to_string(training.vocabulary_size));
      containing[word].push_back(static_cast<std::uint32_t>(i));
    }
  return containing;
}

/// Counts the observations that contain both `word` and each other word.
class CoOccurrence {
 public:
  explicit CoOccurrence(const WordSets& training)
      : training_(training), containing_(invertObservations(training)), both_(training.vocabulary_size, 0) {}

  std::size_t count(Word word) const { return containing_[word].size(); }

  /// The result is valid until the next call.
  const std::vector<std::uint32_t>& with(Word word) {
    std::fill(both_.begin(), both_.end(), 0u);
    for (const std::uint32_t i : containing_[word])
      for (const Word other : training_.observations[i]) ++both_[other];
    return both_;
  }

 private:
  const WordSets& training_;
  std::vector<std::vector<std::uint32_t>> containing_;
  std::vector<std::uint32_t> both_;
};

/// Sets the probabilities of `word` given each state of its parent, from the counts of both.
void setConditionals(ChowLiuTree& tree, Word word, std::size_t both, std::size_t own, std::size_t of_parent,
                     std::size_t total) {
  tree.p_parent_present[word] = smoothedFrequency(both, of_parent);
  tree.p_parent_absent[word] = smoothedFrequency(own - both, total - of_parent);
}

bool isProbability(double p) { return p > 0.0 && p < 1.0; }

}  // namespace

float mutualInformation(std::size_t both, std::size_t first, std::size_t second, std::size_t total) {
  const double n = static_cast<double>(total);
  const double p_first = smoothedFrequency(first, total), p_second = smoothedFrequency(second, total);
  const auto term = [n](std::size_t count, double p_a, double p_b) {
    if (count == 0) return 0.0;
    const double joint = static_cast<double>(count) / n;
    return joint * std::log(joint / (p_a * p_b));
  };
  return static_cast<float>(term(total + both - first - second, 1.0 - p_first, 1.0 - p_second) +
                            term(second - both, 1.0 - p_first, p_second) + term(first - both, p_first, 1.0 - p_second) +
                            term(both, p_first, p_second));
}

ChowLiuTree learnChowLiuTree(const WordSets& training, const std::function<void(double)>& progress) {
  const std::size_t words = training.vocabulary_size, total = training.observations.size();
  if (total == 0 || words == 0) throw UserError("training", "no observations", "at least one");
  CoOccurrence pairs(training);
  ChowLiuTree tree{std::vector<Word>(words), std::vector<double>(words), std::vector<double>(words),
                   std::vector<double>(words)};
  for (Word q = 0; q < words; ++q) tree.p[q] = smoothedFrequency(pairs.count(q), total);

  // Prim (1957): adds the word outside the tree with the strongest link to it.
  std::vector<float> strongest(words, -std::numeric_limits<float>::infinity());
  std::vector<std::uint32_t> shared(words, 0);  // observations with the word and its candidate parent
  std::vector<Word> outside(words);
  std::iota(outside.begin(), outside.end(), Word{0});
  Word joined = 0;
  for (Word q = 1; q < words; ++q)
    if (pairs.count(q) > pairs.count(joined)) joined = q;
  tree.parent[joined] = joined;
  tree.p_parent_present[joined] = tree.p_parent_absent[joined] = tree.p[joined];
  outside.erase(outside.begin() + joined);
  while (!outside.empty()) {
    const std::vector<std::uint32_t>& both = pairs.with(joined);
    std::size_t next = 0;
    for (std::size_t k = 0; k < outside.size(); ++k) {
      const Word q = outside[k];
      const float information = mutualInformation(both[q], pairs.count(joined), pairs.count(q), total);
      if (information > strongest[q]) {
        strongest[q] = information;
        tree.parent[q] = joined;
        shared[q] = both[q];
      }
      const Word best = outside[next];
      if (strongest[q] > strongest[best] || (strongest[q] == strongest[best] && q < best)) next = k;
    }
    joined = outside[next];
    outside[next] = outside.back();
    outside.pop_back();
    setConditionals(tree, joined, shared[joined], pairs.count(joined), pairs.count(tree.parent[joined]), total);
    if (!progress || outside.size() % kProgressEvery != 0) continue;
    const double left = static_cast<double>(outside.size()) / static_cast<double>(words);
    progress(1.0 - left * left);  // each word is compared with all words outside the tree
  }
  return tree;
}

double totalInformation(const ChowLiuTree& tree, const WordSets& training) {
  CoOccurrence pairs(training);
  double sum = 0.0;
  for (Word q = 0; q < tree.size(); ++q) {
    if (tree.parent[q] == q) continue;
    sum += static_cast<double>(mutualInformation(pairs.with(tree.parent[q])[q], pairs.count(tree.parent[q]),
                                                 pairs.count(q), training.observations.size()));
  }
  return sum;
}

void checkTree(const ChowLiuTree& tree, const std::string& name) {
  std::vector<std::vector<Word>> children(tree.size());
  std::vector<Word> reached;
  for (Word q = 0; q < tree.size(); ++q) {
    const std::string where = name + ": word " + std::to_string(q);
    if (tree.parent[q] >= tree.size())
      throw UserError(where, "parent " + std::to_string(tree.parent[q]), "below " + std::to_string(tree.size()));
    if (!isProbability(tree.p[q]) || !isProbability(tree.p_parent_present[q]) ||
        !isProbability(tree.p_parent_absent[q]))
      throw UserError(where, "a probability outside (0, 1)", "above 0 and below 1");
    if (tree.parent[q] == q) reached.push_back(q);
    else children[tree.parent[q]].push_back(q);
  }
  if (reached.size() != 1)
    throw UserError(name, std::to_string(reached.size()) + " roots", "one word that is its own parent");
  for (std::size_t i = 0; i < reached.size(); ++i)
    reached.insert(reached.end(), children[reached[i]].begin(), children[reached[i]].end());
  if (reached.size() != tree.size())
    throw UserError(name, std::to_string(tree.size() - reached.size()) + " words in a cycle of parents",
                    "each word descends from the root");
}

}  // namespace fabmap_node
