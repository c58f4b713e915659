// SPDX-License-Identifier: BSD-3-Clause
#include "filter/components.hpp"

#include <utility>

#include "sgm/semi_global.hpp"

namespace dense_stereo {

namespace {

constexpr std::int32_t kNoLabel = -1;

bool areConnected(std::uint16_t a, std::uint16_t b) { return static_cast<unsigned>(a - b + 1) <= 2U; }

}  // namespace

std::int32_t SmallComponents::find(std::int32_t label) {
  std::int32_t* const parents = parents_.data();
  while (parents[label] != label) label = parents[label] = parents[parents[label]];
  return label;
}

std::int32_t SmallComponents::join(std::int32_t a, std::int32_t b) {
  if (a == b) return a;
  a = find(a);
  b = find(b);
  if (a == b) return a;
  if (b < a) std::swap(a, b);
  parents_[static_cast<std::size_t>(b)] = a;
  return a;
}

void SmallComponents::remove(Padded<std::uint16_t>& disparity, int least) {
  labels_.resize(disparity.width(), disparity.height());
  parents_.resize(static_cast<std::size_t>(disparity.width()) * static_cast<std::size_t>(disparity.height()));
  sizes_.resize(parents_.size());
  count_ = 0;
  for (int v = 0; v < disparity.height(); ++v) labelRow(disparity, v);
  for (std::int32_t label = count_ - 1; label >= 0; --label) {
    const std::int32_t parent = parents_[static_cast<std::size_t>(label)];  // older, hence processed later
    if (parent != label) sizes_[static_cast<std::size_t>(parent)] += sizes_[static_cast<std::size_t>(label)];
  }
  for (int v = 0; v < disparity.height(); ++v) {
    std::uint16_t* d = disparity.row(v);
    const std::int32_t* labels = labels_.row(v);
    std::int32_t last = kNoLabel;
    bool is_small = false;
    for (int u = 0; u < disparity.width(); ++u) {
      if (labels[u] != last) {
        last = labels[u];
        is_small = last != kNoLabel && sizes_[static_cast<std::size_t>(find(last))] < least;
      }
      if (is_small) d[u] = Winners::kInvalid;
    }
  }
}

void SmallComponents::labelRow(const Padded<std::uint16_t>& disparity, int v) {
  const int width = disparity.width();
  const std::uint16_t* d = disparity.row(v);
  const std::uint16_t* above = disparity.clampedRow(v - 1);
  std::int32_t* labels = labels_.row(v);
  const std::int32_t* labels_above = labels_.clampedRow(v - 1);
  labels[-1] = kNoLabel;
  labels[width] = kNoLabel;
  std::int32_t run = kNoLabel, run_length = 0;  // pixels not yet counted
  for (int u = 0; u < width; ++u) {
    std::int32_t label = kNoLabel;
    if (d[u] != Winners::kInvalid) {
      if (areConnected(d[u], d[u - 1]) && labels[u - 1] != kNoLabel) label = labels[u - 1];
      if (v > 0)
        for (int k = u - 1; k <= u + 1; ++k)
          if (labels_above[k] != label && labels_above[k] != kNoLabel && areConnected(d[u], above[k]))
            label = label == kNoLabel ? labels_above[k] : join(label, labels_above[k]);
      if (label == kNoLabel) {
        label = count_++;
        parents_[static_cast<std::size_t>(label)] = label;
        sizes_[static_cast<std::size_t>(label)] = 0;
      }
    }
    labels[u] = label;
    if (label == run) {
      ++run_length;
      continue;
    }
    if (run != kNoLabel) sizes_[static_cast<std::size_t>(run)] += run_length;
    run = label;
    run_length = 1;
  }
  if (run != kNoLabel) sizes_[static_cast<std::size_t>(run)] += run_length;
}

}  // namespace dense_stereo
