// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "fabmap_node/model/chow_liu_tree.hpp"

namespace fabmap_node {

/// Reads bags of words in the format of openFABMAP: OpenCV's YAML (also .gz) with one matrix, one row per observation,
/// one column per word. A word is present if its element is positive.
/// Throws UserError with the file for any other content, and for elements that are not finite.
WordSets readBagsOfWords(const std::string& path);

/// Reads a tree in the format of openFABMAP: a matrix of 4 rows (parent, p, p given parent present, p given parent
/// absent) and one column per word. Throws UserError with the file unless it is a single tree.
ChowLiuTree readTree(const std::string& path);

/// Writes `tree` in the same format; a name that ends in .gz is compressed. Throws UserError if the file cannot be
/// written.
void writeTree(const std::string& path, const ChowLiuTree& tree);

}  // namespace fabmap_node
