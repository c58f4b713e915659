// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "fabmap_node/model/chow_liu_tree.hpp"

namespace fabmap_node {

/// Reads bags of words as openFABMAP writes them: OpenCV's YAML (also .gz) with one matrix, one row per observation,
/// one column per word. A word counts as present if its entry is above 0.
/// Throws UserError with the file for what is not such a matrix, or holds entries that are not finite.
WordSets readBagsOfWords(const std::string& path);

/// Reads a tree as openFABMAP writes it: a matrix of 4 rows (parent, p, p given parent present, p given parent absent)
/// and one column per word. Throws UserError with the file unless it is one tree.
ChowLiuTree readTree(const std::string& path);

/// Writes `tree` in the same format; a name that ends in .gz is compressed. Throws UserError if the file cannot be
/// written.
void writeTree(const std::string& path, const ChowLiuTree& tree);

}  // namespace fabmap_node
