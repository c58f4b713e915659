// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/places/word_postings.hpp"

namespace fabmap_node {
namespace {

constexpr std::size_t kBlockPlaces = 4096;                 // 32 KiB of sums
constexpr std::size_t kFrequentPlaces = kBlockPlaces / 8;  // above which bits are faster than a list (bench/speed.cpp)
constexpr std::size_t kOctetWords = 8;

/// Processes four at a time: the places of a list are distinct, which the compiler cannot know.
void addToPlaces(const std::uint16_t* places, const std::uint16_t* end, double weight, double* sums) {
  for (; end - places >= 4; places += 4) {
    const double a = sums[places[0]] + weight, b = sums[places[1]] + weight;
    const double c = sums[places[2]] + weight, d = sums[places[3]] + weight;
    sums[places[0]] = a;
    sums[places[1]] = b;
    sums[places[2]] = c;
    sums[places[3]] = d;
  }
  for (; places != end; ++places) sums[*places] += weight;
}

/// Returns the sums of the weights of all subsets of eight words.
std::array<double, 256> sumSubsets(const std::array<double, kOctetWords>& weights) {
  std::array<double, 256> sums{};
  for (std::size_t bit = 0; bit < kOctetWords; ++bit)
    for (std::size_t subset = 0; subset < std::size_t{1} << bit; ++subset)
      sums[subset | std::size_t{1} << bit] = sums[subset] + weights[bit];
  return sums;
}

}  // namespace

void WordPostings::add(const WordSet& place) {
  const auto number = static_cast<std::uint16_t>(size_ % kBlockPlaces);
  for (const Word q : place) open_[q].push_back(number);
  if (++size_ % kBlockPlaces == 0) closeBlock();
}

/// Moves words of the open block that occur in many places into octets.
std::vector<WordPostings::WordOctet> WordPostings::takeFrequentWords() {
  std::vector<WordOctet> octets;
  std::size_t count = 0;
  for (Word q = 0; q < open_.size(); ++q) {
    if (open_[q].size() <= kFrequentPlaces) continue;
    const std::size_t bit = count++ % kOctetWords;
    if (bit == 0) {
      octets.emplace_back();
      octets.back().words.fill(q);  // unused bits may have any word
      octets.back().bits.assign(kBlockPlaces, 0);
    }
    octets.back().words[bit] = q;
    for (const std::uint16_t place : open_[q])
      octets.back().bits[place] = static_cast<std::uint8_t>(octets.back().bits[place] | 1u << bit);
    open_[q].clear();
  }
  return octets;
}

void WordPostings::closeBlock() {
  FullBlock block;
  block.frequent = takeFrequentWords();
  std::size_t total = 0;
  for (const auto& places : open_) total += places.size();
  block.places.reserve(total);
  block.begin.reserve(open_.size() + 1);
  for (auto& places : open_) {
    block.begin.push_back(static_cast<std::uint32_t>(block.places.size()));
    block.places.insert(block.places.end(), places.begin(), places.end());
    places.clear();
  }
  block.begin.push_back(static_cast<std::uint32_t>(total));
  full_.push_back(std::move(block));
}

void WordPostings::addWeights(const std::vector<WeightedWord>& words, std::vector<double>& sums) const {
  std::vector<double> weights(open_.size(), 0.0);
  for (const WeightedWord& each : words) weights[each.word] = each.weight;
  double* block_sums = sums.data();
  for (const FullBlock& block : full_) {
    const std::uint16_t* places = block.places.data();
    for (const WeightedWord& each : words)
      addToPlaces(places + block.begin[each.word], places + block.begin[each.word + 1], each.weight, block_sums);
    for (const WordOctet& octet : block.frequent) {
      std::array<double, kOctetWords> octet_weights{};
      for (std::size_t bit = 0; bit < kOctetWords; ++bit) octet_weights[bit] = weights[octet.words[bit]];
      if (octet_weights == std::array<double, kOctetWords>{}) continue;
      const std::array<double, 256> subset_sums = sumSubsets(octet_weights);
      for (std::size_t i = 0; i < kBlockPlaces; ++i) block_sums[i] += subset_sums[octet.bits[i]];
    }
    block_sums += kBlockPlaces;
  }
  for (const WeightedWord& each : words) {
    const auto& places = open_[each.word];
    addToPlaces(places.data(), places.data() + places.size(), each.weight, block_sums);
  }
}

}  // namespace fabmap_node
