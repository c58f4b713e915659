// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <chrono>

#include "base/console.hpp"
#include "base/json.hpp"
#include "base/matrix_file.hpp"
#include "base/parameters.hpp"
#include "base/plot.hpp"
#include "topics/loops/cloud_units.hpp"
#include "topics/loops/loops.hpp"
#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/icp/align.hpp"
#include "urban_nav_registration/icp/offset_frames.hpp"
#include "urban_nav_registration/pictures/cloud_picture.hpp"

namespace urban_nav {

using urban_nav_core::CloudFile;
using urban_nav_core::Pose;
using urban_nav_core::UserError;
using urban_nav_registration::Alignment;
using urban_nav_registration::CloudOffsets;

namespace {

using Clock = std::chrono::steady_clock;

/// Returns the pose of a 3x4 or 4x4 matrix.
Pose readInitial(const std::string& path) {
  const std::vector<double> numbers = readMatrixFile(path);
  const char* const allowed = "12 or 16: the rows of T_target_source";
  if (numbers.size() != 12 && numbers.size() != 16)
    throw UserError(path, std::to_string(numbers.size()) + " numbers", allowed);
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> top(numbers.data());
  const urban_nav_core::Matrix3d R = top.leftCols<3>();
  const bool rotates =
      (R * R.transpose() - urban_nav_core::Matrix3d::Identity()).norm() < 1e-2 && R.determinant() > 0.0;
  const bool ends =
      numbers.size() == 12 || (numbers[12] == 0.0 && numbers[13] == 0.0 && numbers[14] == 0.0 && numbers[15] == 1.0);
  if (!rotates || !ends)
    throw UserError(path, "a matrix that is not a rigid transform", "a rotation and a translation, last row 0 0 0 1");
  return Pose(R, top.col(3));
}

template <typename Matrix>
Json rowMajor(const Matrix& matrix) {
  Json json = Json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r)
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) json.append(matrix(r, c));
  return json;
}

Json testsJson(const Alignment& alignment) {
  Json tests = Json::array();
  for (const urban_nav_registration::AlignmentTest& test : alignment.tests) {
    Json json = Json::object();
    json["name"] = test.name;
    json["value"] = test.value;
    json[test.at_least ? "at_least" : "at_most"] = test.threshold;
    json["passed"] = test.passed;
    tests.append(json);
  }
  return tests;
}

std::string toReason(const Alignment& alignment) {
  if (alignment.reason == urban_nav_registration::AlignmentReason::None) return "";
  return std::string(toString(alignment.reason)) + ": " + alignment.sentence;
}

Json toJson(const Alignment& alignment, double ms) {
  Json json = Json::object();
  json["T_target_source"] = rowMajor(alignment.T_target_source.matrix());
  json["covariance"] = rowMajor(alignment.covariance);
  json["information"] = rowMajor(alignment.information);
  Json directions = Json::array();
  for (const urban_nav_core::Vector6d& direction : alignment.free_directions) directions.append(rowMajor(direction));
  json["free_directions"] = directions;
  json["planar"] = alignment.planar;
  json["verdict"] = toString(alignment.verdict);
  json["reason"] = toReason(alignment);
  json["tests"] = testsJson(alignment);
  json["global_search"] = alignment.searched;
  if (alignment.alternative) {
    json["rival"] = Json::object();
    json["rival"]["T_target_source"] = rowMajor(alignment.alternative->T_target_source.matrix());
    json["rival"]["share"] = alignment.alternative->share;
  }
  json["matches"] = alignment.matches;
  json["iterations"] = alignment.iterations;
  json["source_points"] = alignment.source_points;
  json["target_points"] = alignment.target_points;
  json["ms"] = ms;
  return json;
}

std::string toText(const Alignment& alignment, double ms) {
  using urban_nav_core::printNumber;
  std::string text = toString(alignment.verdict);
  if (alignment.reason != urban_nav_registration::AlignmentReason::None) text += ": " + toReason(alignment);
  text += "\nT_target_source\n";
  const Eigen::Matrix4d T = alignment.T_target_source.matrix();
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) text += (c == 0 ? "" : " ") + printNumber(T(r, c));
    text += "\n";
  }
  if (alignment.planar) text += "planar scans: height, roll and pitch are not measured\n";
  for (const urban_nav_core::Vector6d& direction : alignment.free_directions) {
    text += "free:";
    for (int i = 0; i < 6; ++i) text += " " + urban_nav_core::formatNumber(direction[i], 3);
    text += "\n";
  }
  for (const urban_nav_registration::AlignmentTest& test : alignment.tests)
    text += test.name + " " + urban_nav_core::formatNumber(test.value, 3) +
            (test.at_least ? ", at least " : ", at most ") + urban_nav_core::formatNumber(test.threshold, 3) +
            (test.passed ? "\n" : ": no\n");
  return text + std::to_string(alignment.iterations) + " iterations, " + urban_nav_core::formatNumber(ms, 3) + " ms\n";
}

/// Reads a cloud, centred at its mean: single precision and the linearised rotation are accurate near the origin only.
CloudFile readNamed(const std::string& path, Console& console) {
  CloudFile file = urban_nav_core::readCloud(path);
  std::size_t bad = 0;
  for (const Eigen::Vector3f& point : file.cloud.points) bad += point.allFinite() ? 0 : 1;
  if (bad > 0)
    console.warn(path + ": " + std::to_string(bad) + " of " + std::to_string(file.cloud.points.size()) +
                 " points are not finite: left out");
  urban_nav_core::recentre(file);
  return file;
}

int runIcp(const Arguments& arguments, Console& console) {
  const ParameterSet parameters = loadParameters(arguments);
  for (const std::string& warning : parameterWarnings(parameters)) console.warn(warning);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const Pose guess = arguments.has("initial") ? readInitial(arguments.get("initial")) : Pose();
  const CloudFile source = readNamed(arguments.get("SOURCE"), console),
                  target = readNamed(arguments.get("TARGET"), console);
  const CloudOffsets offsets{source.offset, target.offset};
  const Pose near_guess = urban_nav_registration::relativeToOffsets(guess, offsets);
  const auto begin = Clock::now();
  const Alignment about_middles = urban_nav_registration::align(
      source.cloud, target.cloud, parameters.get(urban_nav_registration::table()), near_guess,
      arguments.has("global") ? urban_nav_registration::SearchMode::AtOnce
                              : urban_nav_registration::SearchMode::IfRejected);
  Alignment alignment = urban_nav_registration::toFileFrames(about_middles, offsets);
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  if (alignment.verdict == urban_nav_core::ClosureVerdict::Rejected)
    if (const std::string units = describeUnits(source, target); !units.empty()) alignment.sentence += "; " + units;
  console.print(toText(alignment, ms));
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), toJson(alignment, ms).print());
  if (arguments.has("picture")) {
    urban_nav_registration::CloudPictureOptions options;
    options.free_directions = about_middles.free_directions;
    options.caption = "red: target, blue: source; " + std::string(toString(alignment.verdict)) +
                      (alignment.sentence.empty() ? "" : ": " + alignment.sentence);
    const auto jpeg = urban_nav_registration::encodeJpeg(urban_nav_registration::drawClouds(
        source.cloud, target.cloud, near_guess, about_middles.T_target_source, options));
    urban_nav_core::writeAtomically(arguments.get("picture"), std::string(jpeg.begin(), jpeg.end()));
  }
  return alignment.verdict == urban_nav_core::ClosureVerdict::Rejected ? 1 : 0;
}

std::string help(const Arguments& arguments) { return stageHelp(arguments, urban_nav_registration::table().stage()); }

}  // namespace

Command icpCommand() {
  Command command;
  command.name = "icp";
  command.summary = "Aligns two point clouds: transform, information and verdict.";
  const char* const formats = "PLY, PCD, LAS, or CSV with or without a header; .gz of each";
  command.options = {
      {"SOURCE", "", std::string("source cloud, which is moved: ") + formats, true, false, {}},
      {"TARGET", "", std::string("target cloud: ") + formats, true, false, {}},
      {"--initial",
       "FILE",
       "first guess of T_target_source: 12 or 16 numbers, row by row (default: the identity)",
       false,
       false,
       {}},
      {"--global",
       "",
       "search for the pose at all headings; otherwise only if the alignment from the guess is rejected",
       false,
       false,
       {}},
      {"--picture", "FILE.jpg", "both clouds, from above and from the side, before and after", false, false, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav icp source.ply target.ply --json alignment.json",
                      "urban_nav icp a.pcd b.csv.gz --global"};
  command.more_help = help;
  command.run = runIcp;
  return command;
}

}  // namespace urban_nav
