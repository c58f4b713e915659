// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/inertial/axis_map.hpp"

#include <algorithm>
#include <array>
#include <sstream>

namespace urban_nav_core {

std::optional<Eigen::Matrix3d> parseAxisMap(const std::string& text) {
  Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
  std::istringstream words(text);
  std::string word;
  int row = 0;
  for (; std::getline(words, word, ','); ++row) {
    const bool negative = word.size() == 2 && word[0] == '-';
    if (row == 3 || word.size() != (negative ? 2U : 1U) || word.back() < 'x' || word.back() > 'z') return std::nullopt;
    map(row, word.back() - 'x') = negative ? -1.0 : 1.0;
  }
  const bool each_once = (map.cwiseAbs().colwise().sum().array() == 1.0).all();
  if (row != 3 || !each_once || text.back() == ',') return std::nullopt;
  return map;
}

std::string printAxisMap(const Eigen::Matrix3d& map) {
  std::string text;
  for (int row = 0; row < 3; ++row) {
    int column = 0;
    const double sign = map.row(row).cwiseAbs().maxCoeff(&column) * map(row, column);
    text += (row > 0 ? "," : "") + std::string(sign < 0.0 ? "-" : "") + static_cast<char>('x' + column);
  }
  return text;
}

std::vector<Eigen::Matrix3d> allAxisMaps() {
  std::vector<Eigen::Matrix3d> maps;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (unsigned signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
      for (int row = 0; row < 3; ++row)
        map(row, order[static_cast<std::size_t>(row)]) = (signs >> static_cast<unsigned>(row)) % 2 == 0 ? 1.0 : -1.0;
      maps.push_back(map);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return maps;
}

}  // namespace urban_nav_core
