// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/covariance_csv.hpp"

#include <stdexcept>

#include "io/reader_check.hpp"

namespace urban_nav_core {
namespace {

Matrix6d someCovariance() {
  Matrix6d A;
  for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = std::sin(1.0 + i * i);
  return A * A.transpose() / 3.0;
}

Matrix6d symmetric(const Matrix6d& M) { return 0.5 * (M + M.transpose()); }

std::string covariances() {
  return covarianceHeader() +
         printCovarianceRow(CovarianceRow{1225719873501685123, Health::Lost, symmetric(someCovariance())}) +
         printCovarianceRow(CovarianceRow{1225719873551685123, Health::Ok, Matrix6d::Identity()});
}

std::string relatives() {
  return relativeCovarianceHeader() +
         printCovarianceRow(RelativeCovarianceRow{1, 2, Health::Degraded, symmetric(someCovariance())});
}

TEST(CovarianceCsv, RoundTripIsExact) {
  const auto rows = parseCovariances(covariances(), "c.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].stamp, 1225719873501685123);
  EXPECT_EQ(rows[0].status, Health::Lost);
  EXPECT_EQ(rows[0].covariance, symmetric(someCovariance()));
  const auto relative = parseRelativeCovariances(relatives(), "c.csv");
  ASSERT_EQ(relative.size(), 1U);
  EXPECT_EQ(relative[0].to, 2);
  EXPECT_EQ(relative[0].status, Health::Degraded);
  EXPECT_EQ(relative[0].covariance, symmetric(someCovariance()));
}

TEST(CovarianceCsv, HeadersBeginAsPromised) {
  EXPECT_EQ(covarianceHeader().rfind("stamp_ns,status,c11,c12,", 0), 0U);
  EXPECT_EQ(relativeCovarianceHeader().rfind("stamp_from_ns,stamp_to_ns,status,c11,", 0), 0U);
  EXPECT_EQ(covarianceHeader().substr(covarianceHeader().size() - 5), ",c66\n");
}

TEST(CovarianceCsv, NamesFileAndLine) {
  std::string text = covariances();
  text.replace(text.find("LOST"), 4, "GONE");
  EXPECT_EQ(catchError([&] { parseCovariances(text, "c.csv"); }),
            "c.csv:2: status GONE: expected OK, DEGRADED, LOST, RECOVERED");
  Matrix6d lopsided = Matrix6d::Identity();
  lopsided(0, 1) = 0.1;
  const std::string header = covarianceHeader();
  EXPECT_NE(catchError([&] {
              parseCovariances(header + printCovarianceRow(CovarianceRow{1, Health::Ok, lopsided}), "c.csv");
            }).find("c.csv:2: no covariance"),
            std::string::npos);
  EXPECT_NE(
      catchError([&] {
        parseCovariances(header + printCovarianceRow(CovarianceRow{1, Health::Ok, -Matrix6d::Identity()}), "c.csv");
      }),
      "");
  EXPECT_NE(catchError([&] {
              parseCovariances(relatives(), "c.csv");
            }).find("39 columns: expected 38: stamp_ns,status,c11..."),
            std::string::npos);
}

TEST(CovarianceCsv, Fuzzed) {
  expectSurvives(testing::fuzzText({covariances()}, [](const std::string& text) {
    for (const auto& row : parseCovariances(text, "c")) {
      if (!row.covariance.allFinite()) throw std::runtime_error("a covariance that is not finite");
    }
  }));
  expectSurvives(
      testing::fuzzText({relatives()}, [](const std::string& text) { parseRelativeCovariances(text, "c"); }));
}

}  // namespace
}  // namespace urban_nav_core
