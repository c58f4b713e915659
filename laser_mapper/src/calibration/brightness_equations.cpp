// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/brightness_equations.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace laser_mapper {

using Eigen::Index;
using Eigen::VectorXd;
using urban_nav_core::Vector6d;

namespace {

using CorrectionPair = Eigen::Matrix<double, 12, 1>;  // at a second and at the next one

std::vector<std::uint32_t> findSeconds(const std::vector<std::vector<BrightnessRow>>& points) {
  std::vector<std::uint32_t> seconds;
  for (const std::vector<BrightnessRow>& rows : points)
    for (const BrightnessRow& row : rows)
      for (const std::uint32_t second : {row.view_share.second, row.point_share.second}) {
        seconds.push_back(second);
        seconds.push_back(second + 1);
      }
  std::sort(seconds.begin(), seconds.end());
  seconds.erase(std::unique(seconds.begin(), seconds.end()), seconds.end());
  return seconds;
}

/// Row of an observation by its three dense parts: terms, corrections at the view, corrections at the point.
struct RowParts {
  TermVector terms;
  std::array<CorrectionPair, 2> corrections;
  std::array<Index, 2> at;  ///< first row of each pair
};

CorrectionPair dividedBetween(const Vector6d& derivatives, double next) {
  CorrectionPair both;
  both << (1.0 - next) * derivatives, next * derivatives;
  return both;
}

class PlaceSum {
 public:
  explicit PlaceSum(const std::vector<std::vector<BrightnessRow>>& points) {
    sum_.seconds = findSeconds(points);
    const auto size = static_cast<Index>(kCalibrationTerms + 6 * sum_.seconds.size());
    sum_.information.setZero(size, size);
    sum_.gradient.setZero(size);
    mean_.setZero(size);
    for (const std::vector<BrightnessRow>& rows : points) addPoint(rows);
  }

  PlaceEquations take(double variance) {
    sum_.information /= variance;
    sum_.gradient /= variance;
    return std::move(sum_);
  }

 private:
  RowParts divide(const BrightnessRow& row) const {
    const auto slot = [this](std::uint32_t second) {
      const auto found = std::lower_bound(sum_.seconds.begin(), sum_.seconds.end(), second);
      return static_cast<Index>(kCalibrationTerms + 6 * (found - sum_.seconds.begin()));
    };
    return {row.terms,
            {dividedBetween(row.at_view, row.view_share.next), dividedBetween(row.at_point, row.point_share.next)},
            {slot(row.view_share.second), slot(row.point_share.second)}};
  }

  void addProducts(const RowParts& row) {
    Eigen::MatrixXd& H = sum_.information;
    H.topLeftCorner<kCalibrationTerms, kCalibrationTerms>() += row.terms * row.terms.transpose();
    for (std::size_t i = 0; i < 2; ++i) {
      H.block<12, kCalibrationTerms>(row.at[i], 0) += row.corrections[i] * row.terms.transpose();
      for (std::size_t j = 0; j < 2; ++j)
        H.block<12, 12>(row.at[i], row.at[j]) += row.corrections[i] * row.corrections[j].transpose();
    }
  }

  static void addScaled(const RowParts& row, double scale, VectorXd& to) {
    to.head<kCalibrationTerms>() += scale * row.terms;
    for (std::size_t i = 0; i < 2; ++i) to.segment<12>(row.at[i]) += scale * row.corrections[i];
  }

  void addPoint(const std::vector<BrightnessRow>& rows) {
    const auto count = static_cast<double>(rows.size());
    double residual = 0.0;
    for (const BrightnessRow& row : rows) residual += row.residual / count;
    mean_.setZero();
    for (const BrightnessRow& row : rows) {
      const RowParts parts = divide(row);
      addProducts(parts);
      addScaled(parts, 1.0 / count, mean_);
      addScaled(parts, residual - row.residual, sum_.gradient);  // differences sum to zero, so the mean has no effect
    }
    sum_.information.topLeftCorner<kCalibrationTerms, kCalibrationTerms>() -=
        count * mean_.head<kCalibrationTerms>() * mean_.head<kCalibrationTerms>().transpose();
    for (Index column = 0; column < mean_.size(); ++column) {
      const Index from = std::max<Index>(column, kCalibrationTerms), rest = mean_.size() - from;
      if (mean_(column) != 0.0) sum_.information.col(column).tail(rest) -= count * mean_(column) * mean_.tail(rest);
    }
  }

  PlaceEquations sum_;
  VectorXd mean_;  ///< mean of the rows of one point
};

}  // namespace

PlaceEquations sumBrightnessRows(const std::vector<std::vector<BrightnessRow>>& points, double variance) {
  return PlaceSum(points).take(variance);
}

}  // namespace laser_mapper
