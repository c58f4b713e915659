// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/covariance_csv.hpp"

#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr std::size_t kNumbers = 36;

std::string columns() {
  std::string names;
  for (char row = '1'; row <= '6'; ++row) {
    for (char column = '1'; column <= '6'; ++column) names += std::string(",c") + row + column;
  }
  return names + "\n";
}

void appendMatrix(std::string& line, const Matrix6d& M) {
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      line += ',';
      appendNumber(line, M(row, column));
    }
  }
  line += '\n';
}

Health statusAt(const CsvTable& table, std::size_t row, std::size_t column) {
  const auto status = parseHealth(table.text(row, column));
  if (!status) throw UserError(table.where(row), "status " + table.text(row, column), "OK, DEGRADED, LOST, RECOVERED");
  return *status;
}

Matrix6d matrixAt(const CsvTable& table, std::size_t row, std::size_t first) {
  Matrix6d M;
  for (std::size_t i = 0; i < kNumbers; ++i)
    M(static_cast<int>(i / 6), static_cast<int>(i % 6)) = table.number(row, first + i);
  const bool symmetric = ((M - M.transpose()).array().abs() <= 1e-9 * M.array().abs().maxCoeff()).all();
  if (!symmetric || M.diagonal().minCoeff() < 0.0)
    throw UserError(table.where(row), "no covariance", "a symmetric matrix with variances of 0 or more");
  return M;
}

CsvTable makeTable(std::string_view text, const std::string& name, const std::string& header) {
  CsvTable table = CsvTable::parse(text, name);
  const std::size_t wanted = CsvTable::parse(header, name).header().size();
  if (table.header().size() != wanted) {
    throw UserError(name, std::to_string(table.header().size()) + " columns",
                    std::to_string(wanted) + ": " + header.substr(0, header.find(",c12")) + "...");
  }
  return table;
}

}  // namespace

std::string covarianceHeader() { return "stamp_ns,status" + columns(); }
std::string relativeCovarianceHeader() { return "stamp_from_ns,stamp_to_ns,status" + columns(); }

std::string printCovarianceRow(const CovarianceRow& row) {
  std::string line = std::to_string(row.stamp) + "," + toString(row.status);
  appendMatrix(line, row.covariance);
  return line;
}

std::string printCovarianceRow(const RelativeCovarianceRow& row) {
  std::string line = std::to_string(row.from) + "," + std::to_string(row.to) + "," + toString(row.status);
  appendMatrix(line, row.covariance);
  return line;
}

std::vector<CovarianceRow> parseCovariances(std::string_view text, const std::string& name) {
  const CsvTable table = makeTable(text, name, covarianceHeader());
  std::vector<CovarianceRow> rows;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    rows.push_back({table.integer(i, 0), statusAt(table, i, 1), matrixAt(table, i, 2)});
  }
  return rows;
}

std::vector<RelativeCovarianceRow> parseRelativeCovariances(std::string_view text, const std::string& name) {
  const CsvTable table = makeTable(text, name, relativeCovarianceHeader());
  std::vector<RelativeCovarianceRow> rows;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    rows.push_back({table.integer(i, 0), table.integer(i, 1), statusAt(table, i, 2), matrixAt(table, i, 3)});
  }
  return rows;
}

std::vector<CovarianceRow> readCovariances(const std::string& path) {
  return parseCovariances(readTextFile(path), path);
}

}  // namespace urban_nav_core
