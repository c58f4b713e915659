// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/closures_csv.hpp"

#include <array>
#include <cmath>

#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {

namespace {

constexpr std::array<const char*, 7> kPoseColumns = {"x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr double kLengthTolerance = 0.01;  // of a quaternion's length

/// Returns the text of a cell; empty without the column.
std::string findText(const CsvTable& table, std::size_t row, const char* column) {
  return table.has(column) ? table.text(row, table.column(column)) : std::string();
}

std::optional<Pose> readPose(const CsvTable& table, std::size_t row) {
  std::array<double, kPoseColumns.size()> v{};
  for (std::size_t i = 0; i < kPoseColumns.size(); ++i) {
    if (findText(table, row, kPoseColumns[i]).empty()) return std::nullopt;
    v[i] = table.number(row, table.column(kPoseColumns[i]));
  }
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (std::abs(q.norm() - 1.0) > kLengthTolerance)
    throw UserError(table.where(row), "a quaternion of length " + printNumber(q.norm()), "length 1 (1 %)");
  return Pose(q, {v[0], v[1], v[2]});
}

double readSigma(const CsvTable& table, std::size_t row, const char* column) {
  if (findText(table, row, column).empty()) return 0.0;
  const double sigma = table.number(row, table.column(column));
  if (!(sigma > 0.0)) throw UserError(table.where(row), std::string(column) + " = " + printNumber(sigma), "above 0");
  return sigma;
}

ClosureMethod readMethod(const CsvTable& table, std::size_t row) {
  const std::string word = findText(table, row, "kind");
  if (word.empty()) return ClosureMethod::None;
  const std::optional<ClosureMethod> method = parseClosureMethod(word);
  if (!method) throw UserError(table.where(row), "kind = " + word, "stereo, icp, none");
  return *method;
}

std::vector<ClosureRow> listRows(const CsvTable& table) {
  const std::size_t session_a = table.column("session_a"), stamp_a = table.column("stamp_a_ns"),
                    session_b = table.column("session_b"), stamp_b = table.column("stamp_b_ns"),
                    probability = table.column("probability");
  std::vector<ClosureRow> rows;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    ClosureRow row;
    row.a = {table.text(i, session_a), table.integer(i, stamp_a)};
    row.b = {table.text(i, session_b), table.integer(i, stamp_b)};
    row.probability = table.number(i, probability);
    row.where = table.where(i);
    if (!(row.probability >= 0.0 && row.probability <= 1.0))
      throw UserError(row.where, "probability = " + table.text(i, probability), "0...1");
    row.method = readMethod(table, i);
    row.T_a_b = readPose(table, i);
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
  std::string text =
      "session_a,stamp_a_ns,session_b,stamp_b_ns,probability,kind,verdict,reason,x,y,z,qx,qy,qz,qw,weight\n";
  for (const ClosureRow& row : rows) {
    std::vector<std::string> cells = {row.a.session,
                                      std::to_string(row.a.stamp),
                                      row.b.session,
                                      std::to_string(row.b.stamp),
                                      printNumber(row.probability),
                                      toString(row.method),
                                      row.verdict ? toString(*row.verdict) : "",
                                      row.reason};
    if (row.T_a_b) {
      const Pose& T = *row.T_a_b;
      for (const double value : {T.t().x(), T.t().y(), T.t().z(), T.q().x(), T.q().y(), T.q().z(), T.q().w()})
        cells.push_back(printNumber(value));
    } else {
      cells.resize(cells.size() + kPoseColumns.size());
    }
    cells.push_back(printNumber(row.weight));
    text += printCsvRow(cells);
  }
  return text;
}

}  // namespace urban_nav_core
