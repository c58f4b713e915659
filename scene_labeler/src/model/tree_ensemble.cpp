// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/tree_ensemble.hpp"

#include <algorithm>

namespace scene_labeler {
namespace {

constexpr std::size_t kNodeBytes = 7;
constexpr std::size_t kMostTrees = 4096, kMostNodes = 4096;

void packNode(const LabelTree::Node& node, std::vector<std::uint8_t>& bytes) {
  const auto left = static_cast<std::uint16_t>(node.left), right = static_cast<std::uint16_t>(node.right);
  for (const unsigned byte : {unsigned{node.feature}, unsigned{node.threshold}, node.missing_right ? 1U : 0U,
                              left & 0xffU, left >> 8U & 0xffU, right & 0xffU, right >> 8U & 0xffU})
    bytes.push_back(static_cast<std::uint8_t>(byte));
}

LabelTree::Node unpackNode(const std::uint8_t* bytes) {
  const auto number = [](std::uint8_t low, std::uint8_t high) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(low | high << 8));
  };
  return {bytes[0], bytes[1], (bytes[2] & 1U) != 0, number(bytes[3], bytes[4]), number(bytes[5], bytes[6])};
}

bool isSoundChild(std::int16_t child, std::size_t parent, std::size_t nodes, std::size_t leaves) {
  if (child < 0) return static_cast<std::size_t>(-1 - child) < leaves;
  return static_cast<std::size_t>(child) > parent && static_cast<std::size_t>(child) < nodes;
}

}  // namespace

std::size_t LabelTree::findLeaf(const std::uint8_t* codes) const {
  if (nodes.empty()) return 0;
  std::int16_t at = 0;
  while (at >= 0) {
    const Node& node = nodes[static_cast<std::size_t>(at)];
    const std::uint8_t code = codes[node.feature];
    const bool goes_right = code == 0 ? node.missing_right : code > node.threshold;
    at = goes_right ? node.right : node.left;
  }
  return static_cast<std::size_t>(-1 - at);
}

void LabelTree::archive(urban_nav_core::Archive& archive) {
  std::vector<std::uint8_t> bytes;
  for (const Node& node : nodes) packNode(node, bytes);
  archive(bytes, leaves);
  archive.require(bytes.size() % kNodeBytes == 0 && bytes.size() / kNodeBytes <= kMostNodes, "a node is truncated");
  if (!archive.isReading()) return;
  nodes.clear();
  for (std::size_t at = 0; at < bytes.size(); at += kNodeBytes) nodes.push_back(unpackNode(bytes.data() + at));
}

void TreeEnsemble::evaluate(const std::uint8_t* codes, float* scores) const {
  const std::size_t size = base.size();
  std::copy(base.begin(), base.end(), scores);
  for (const LabelTree& tree : trees) {
    const float* leaf = tree.leaves.data() + tree.findLeaf(codes) * size;
    for (std::size_t i = 0; i < size; ++i) scores[i] += leaf[i];
  }
}

void TreeEnsemble::archive(urban_nav_core::Archive& archive, std::size_t features) {
  archive(base, trees);
  archive.require(base.size() <= kClassCount && trees.size() <= kMostTrees, "it has too many classes or trees");
  if (!archive.isReading()) return;
  for (const LabelTree& tree : trees) {
    const std::size_t leaves = base.empty() ? 0 : tree.leaves.size() / base.size();
    archive.require(leaves > 0 && leaves * base.size() == tree.leaves.size(), "its leaves lack a value per class");
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      const LabelTree::Node& node = tree.nodes[i];
      archive.require(node.feature < features && isSoundChild(node.left, i, tree.nodes.size(), leaves) &&
                          isSoundChild(node.right, i, tree.nodes.size(), leaves),
                      "a node has a feature or child that does not exist");
    }
  }
}

}  // namespace scene_labeler
