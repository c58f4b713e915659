// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "evaluation/axes.hpp"
#include "urban_nav_core/io/covariance_csv.hpp"
#include "urban_nav_core/trajectory/associate.hpp"
#include "urban_nav_core/trajectory/errors.hpp"
#include "urban_nav_core/trajectory/nees.hpp"
#include "urban_nav_input/truth/trajectory_file.hpp"

namespace urban_nav {

struct SpanError {
  urban_nav_core::Span span;
  urban_nav_core::RelativeError error;
};

/// Errors of an estimate against the truth.
struct Evaluation {
  std::string truth;  ///< file of the truth
  std::size_t frames_truth = 0, frames_estimate = 0;
  urban_nav_core::Matched matched;
  std::optional<urban_nav_core::TimeOffset> offset;  ///< applied, or suggested if few stamps match
  bool offset_applied = false;
  AxesMatch axes;         ///< difference between the files; here both are in the axes of base_link
  double length_m = 0.0;  ///< of the true path
  urban_nav_core::ErrorStatistics first, se3, sim3;  ///< absolute errors by alignment
  std::optional<urban_nav_core::RelativeError> ten_frames;
  std::vector<SpanError> spans;  ///< requested spans that are shorter than the path
  std::optional<urban_nav_core::NeesSummary> nees;
  /// Error of the last pose, with first poses aligned.
  struct End {
    double m = 0.0, deg = 0.0;
    std::optional<double> nees;
  } end;
  std::vector<urban_nav_core::Matrix6d> covariances;  ///< by matched pose; may be empty
};

/// Standard deviation of each pose of the truth, added to the covariance in NEES; independent between poses.
struct TruthSigma {
  double m = 0.0, deg = 0.0;
};

struct EvaluationOptions {
  std::vector<urban_nav_core::Span> spans;
  bool find_offset = false;
  TruthSigma truth_sigma = {};
};

/// DataError if no poses match, with the offset of the stamps that would help, if there is one. `covariances`: of
/// T_first_estimate, found by stamp (or by line where there are no stamps); may be empty.
Evaluation evaluate(const urban_nav_input::TrajectoryFile& truth, const urban_nav_input::TrajectoryFile& estimate,
                    const std::vector<urban_nav_core::CovarianceRow>& covariances, const EvaluationOptions& options);

/// Adds the keys of docs/files.md, and a few more, to an object.
void addToJson(const Evaluation& evaluation, Json& json);

/// Parses "10f", "100m" and so on. Throws UserError for other text.
std::vector<urban_nav_core::Span> parseSpans(const std::vector<std::string>& words);
std::string printSpan(const urban_nav_core::Span& span);

}  // namespace urban_nav
