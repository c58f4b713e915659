// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/replay/openfabmap_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/unpacked_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {

using urban_nav_core::UserError;

namespace {

const char* const kMatrixFile =
    "a YAML file of OpenCV (cv::FileStorage), or such a file with .gz, that holds one matrix";

struct NamedMatrix {
  std::string name;
  cv::Mat values;  // double
};

/// The first matrix of a file.
NamedMatrix readMatrix(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) throw UserError(path, "no such file", kMatrixFile);
  try {
    // readUnpacked() limits the decompressed size; OpenCV does not.
    const cv::FileStorage storage(urban_nav_core::readUnpacked(path), cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (storage.isOpened())
      for (const auto& entry : storage.root()) {
        cv::Mat matrix;
        if (entry.isMap() && !entry["data"].empty()) entry >> matrix;
        if (matrix.empty() || matrix.channels() != 1 || matrix.dims != 2) continue;
        matrix.convertTo(matrix, CV_64F);
        if (!cv::checkRange(matrix)) throw UserError(path, "a number that is not finite", "finite numbers");
        return {entry.name(), matrix};
      }
  } catch (const UserError&) {
    throw;
  } catch (const std::exception& error) {  // OpenCV's reader throws exceptions of the standard library too
    throw UserError(path, "not readable as YAML of OpenCV: " + std::string(error.what()), kMatrixFile);
  }
  throw UserError(path, "holds no matrix", kMatrixFile);
}

/// Refuses matrices of descriptors, as vocabularies hold them, where counts of words are expected: negative numbers,
/// fractions above 1, and names of vocabularies.
void checkCounts(const NamedMatrix& bags, const std::string& path) {
  constexpr const char* kCounts = "how often each word (column) was seen in each image (row), or shares up to 1";
  std::string name = bags.name;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.find("vocab") != std::string::npos || name.find("descriptor") != std::string::npos)
    throw UserError(path, "`" + bags.name + "` is a vocabulary (descriptors of words), not counts of words", kCounts);
  for (int i = 0; i < bags.values.rows; ++i)
    for (int q = 0; q < bags.values.cols; ++q) {
      const double value = bags.values.at<double>(i, q);
      if (value >= 0.0 && (value <= 1.0 || value == std::floor(value))) continue;
      throw UserError(path,
                      "row " + std::to_string(i) + ", word " + std::to_string(q) + " = " +
                          urban_nav_core::printNumber(value) + ": descriptors, as of a vocabulary, not counts of words",
                      kCounts);
    }
}

}  // namespace

WordSets readBagsOfWords(const std::string& path) {
  const NamedMatrix named = readMatrix(path);
  checkCounts(named, path);
  const cv::Mat& bags = named.values;
  WordSets sets;
  sets.vocabulary_size = static_cast<std::size_t>(bags.cols);
  for (int i = 0; i < bags.rows; ++i) {
    WordSet words;
    for (int q = 0; q < bags.cols; ++q)
      if (bags.at<double>(i, q) > 0.0) words.push_back(static_cast<Word>(q));
    sets.observations.push_back(std::move(words));
  }
  return sets;
}

ChowLiuTree readTree(const std::string& path) {
  const cv::Mat rows = readMatrix(path).values;
  if (rows.rows != 4) throw UserError(path, "a matrix of " + std::to_string(rows.rows) + " rows", "4, those of a tree");
  ChowLiuTree tree;
  for (int q = 0; q < rows.cols; ++q) {
    const double parent = rows.at<double>(0, q);
    if (parent < 0.0 || parent >= rows.cols || parent != std::floor(parent))
      throw UserError(path + ": word " + std::to_string(q), "parent " + std::to_string(parent),
                      "a word's number, below " + std::to_string(rows.cols));
    tree.parent.push_back(static_cast<Word>(parent));
    tree.p.push_back(rows.at<double>(1, q));
    tree.p_parent_present.push_back(rows.at<double>(2, q));
    tree.p_parent_absent.push_back(rows.at<double>(3, q));
  }
  checkTree(tree, path);
  return tree;
}

void writeTree(const std::string& path, const ChowLiuTree& tree) {
  cv::Mat rows(4, static_cast<int>(tree.size()), CV_64F);
  for (int q = 0; q < rows.cols; ++q) {
    const auto word = static_cast<std::size_t>(q);
    rows.at<double>(0, q) = static_cast<double>(tree.parent[word]);
    rows.at<double>(1, q) = tree.p[word];
    rows.at<double>(2, q) = tree.p_parent_present[word];
    rows.at<double>(3, q) = tree.p_parent_absent[word];
  }
  urban_nav_core::PartialFile file(path);
  try {
    // The format is given: cv::FileStorage otherwise refuses extensions that it does not know.
    cv::FileStorage storage(file.path(), cv::FileStorage::WRITE | cv::FileStorage::FORMAT_YAML);
    if (!storage.isOpened()) throw UserError(path, "cannot be written", "a file in a folder that exists");
    storage << "ChowLiuTree" << rows;
  } catch (const cv::Exception& error) {
    throw UserError(path, "cannot be written: " + std::string(error.err), "");
  }
  file.commit();
}

}  // namespace fabmap_node
