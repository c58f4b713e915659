// SPDX-License-Identifier: BSD-3-Clause
#include "map/closures_file.hpp"

#include <array>
#include <cmath>

#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::CsvTable;
using urban_nav_core::Pose;
using urban_nav_core::UserError;

namespace {

constexpr std::array<const char*, 7> kPose = {"x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr double kUnit = 0.01;  // by how much a quaternion's length may differ from one

std::optional<Pose> toPose(const CsvTable& table, std::size_t row) {
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < kPose.size(); ++i) {
    if (!table.has(kPose[i]) || table.text(row, table.column(kPose[i])).empty()) return std::nullopt;
    v[i] = table.number(row, table.column(kPose[i]));
  }
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (std::abs(q.norm() - 1.0) > kUnit)
    throw UserError(table.where(row), "a quaternion of length " + urban_nav_core::printNumber(q.norm()),
                    "length 1 (1 %)");
  return Pose(q, {v[0], v[1], v[2]});
}

double readSigma(const CsvTable& table, std::size_t row, const char* column) {
  if (!table.has(column) || table.text(row, table.column(column)).empty()) return 0.0;
  const double sigma = table.number(row, table.column(column));
  if (!(sigma > 0.0))
    throw UserError(table.where(row), std::string(column) + " = " + urban_nav_core::printNumber(sigma), "above 0");
  return sigma;
}

std::vector<ClosureRow> listRows(const CsvTable& table) {
  const std::size_t session_a = table.column("session_a"), stamp_a = table.column("stamp_a_ns"),
                    session_b = table.column("session_b"), stamp_b = table.column("stamp_b_ns"),
                    probability = table.column("probability");
  std::vector<ClosureRow> rows;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    ClosureRow row;
    row.session_a = table.text(i, session_a);
    row.session_b = table.text(i, session_b);
    row.stamp_a = table.integer(i, stamp_a);
    row.stamp_b = table.integer(i, stamp_b);
    row.probability = table.number(i, probability);
    row.where = table.where(i);
    if (!(row.probability >= 0.0 && row.probability <= 1.0))
      throw UserError(row.where, "probability = " + table.text(i, probability), "0...1");
    if (table.has("kind") && !table.text(i, table.column("kind")).empty())
      row.kind = table.text(i, table.column("kind"));
    if (row.kind != "stereo" && row.kind != "icp" && row.kind != "none")
      throw UserError(row.where, "kind = " + row.kind, "stereo, icp, none");
    row.T_a_b = toPose(table, i);
    row.sigma_m = readSigma(table, i, "sigma_m");
    row.sigma_rad = readSigma(table, i, "sigma_rad");
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::vector<ClosureRow> readClosures(const std::string& path) { return listRows(CsvTable::read(path)); }

std::vector<ClosureRow> parseClosures(std::string_view text, const std::string& name) {
  return listRows(CsvTable::parse(text, name));
}

std::string printClosures(const std::vector<ClosureRow>& rows) {
  using urban_nav_core::printNumber;
  std::string text =
      "session_a,stamp_a_ns,session_b,stamp_b_ns,probability,kind,verdict,reason,x,y,z,qx,qy,qz,qw,weight\n";
  for (const ClosureRow& row : rows) {
    std::vector<std::string> cells = {row.session_a,
                                      std::to_string(row.stamp_a),
                                      row.session_b,
                                      std::to_string(row.stamp_b),
                                      printNumber(row.probability),
                                      row.kind,
                                      row.verdict,
                                      row.reason};
    if (row.T_a_b) {
      const Pose& T = *row.T_a_b;
      for (const double value : {T.t().x(), T.t().y(), T.t().z(), T.q().x(), T.q().y(), T.q().z(), T.q().w()})
        cells.push_back(printNumber(value));
    } else {
      cells.resize(cells.size() + kPose.size());
    }
    cells.push_back(printNumber(row.weight));
    text += urban_nav_core::printCsvRow(cells);
  }
  return text;
}

}  // namespace urban_nav
