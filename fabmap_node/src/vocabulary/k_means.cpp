// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/vocabulary/k_means.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <string>

#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

constexpr std::size_t kAssignmentGrain = 64;

/// Fisher-Yates with raw output of the generator: equal with every standard library.
void shuffle(std::vector<ByteDescriptor>& values, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random() % i]);
}

int squaredDistance(const ByteDescriptor& a, const ByteDescriptor& b) {
  int sum = 0;
  for (std::size_t i = 0; i < kDescriptorBytes; ++i) {
    const int d = static_cast<int>(a[i]) - static_cast<int>(b[i]);
    sum += d * d;
  }
  return sum;
}

struct Assignment {
  std::vector<Word> word;
  std::vector<int> distance;
};

Assignment assign(const std::vector<ByteDescriptor>& descriptors, const Vocabulary& vocabulary) {
  Assignment result{std::vector<Word>(descriptors.size()), std::vector<int>(descriptors.size())};
  urban_nav_core::forEach(descriptors.size(), kAssignmentGrain, [&](std::size_t i) {
    result.word[i] = vocabulary.quantise(descriptors[i]);
    result.distance[i] = squaredDistance(descriptors[i], vocabulary.centres()[result.word[i]]);
  });
  return result;
}

std::vector<ByteDescriptor> means(const std::vector<ByteDescriptor>& descriptors, const Assignment& assignment,
                                  std::vector<ByteDescriptor> centres) {
  std::vector<std::array<std::uint32_t, kDescriptorBytes>> sums(centres.size());
  std::vector<std::uint32_t> members(centres.size(), 0);
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    ++members[assignment.word[i]];
    for (std::size_t k = 0; k < kDescriptorBytes; ++k) sums[assignment.word[i]][k] += descriptors[i][k];
  }
  std::vector<std::size_t> farthest;  // descriptors for empty clusters
  const auto empty = static_cast<std::size_t>(std::count(members.begin(), members.end(), 0u));
  if (empty > 0) {
    farthest.resize(descriptors.size());
    std::iota(farthest.begin(), farthest.end(), std::size_t{0});
    std::partial_sort(farthest.begin(), farthest.begin() + static_cast<std::ptrdiff_t>(empty), farthest.end(),
                      [&](std::size_t a, std::size_t b) {
                        return assignment.distance[a] != assignment.distance[b]
                                   ? assignment.distance[a] > assignment.distance[b]
                                   : a < b;
                      });
  }
  std::size_t next = 0;
  for (std::size_t w = 0; w < centres.size(); ++w) {
    if (members[w] == 0) {
      centres[w] = descriptors[farthest[next++]];
      continue;
    }
    for (std::size_t k = 0; k < kDescriptorBytes; ++k)
      centres[w][k] = static_cast<std::uint8_t>((sums[w][k] + members[w] / 2) / members[w]);
  }
  return centres;
}

}  // namespace

Vocabulary trainVocabulary(std::vector<ByteDescriptor> descriptors, const KMeansOptions& options,
                           const std::function<void(int, int)>& progress) {
  if (descriptors.size() < options.words)
    throw urban_nav_core::UserError("training", std::to_string(descriptors.size()) + " descriptors",
                                    "at least as many as words, " + std::to_string(options.words));
  shuffle(descriptors, options.seed);
  if (descriptors.size() > options.words * options.per_word) descriptors.resize(options.words * options.per_word);
  std::vector<ByteDescriptor> centres(descriptors.begin(),
                                      descriptors.begin() + static_cast<std::ptrdiff_t>(options.words));
  Vocabulary vocabulary(std::move(centres));
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    std::vector<ByteDescriptor> moved = means(descriptors, assign(descriptors, vocabulary), vocabulary.centres());
    const bool settled = moved == vocabulary.centres();
    vocabulary = Vocabulary(std::move(moved));
    if (progress) progress(iteration + 1, options.iterations);
    if (settled) break;
  }
  return vocabulary;
}

}  // namespace fabmap_node
