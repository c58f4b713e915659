// SPDX-License-Identifier: BSD-3-Clause
#include "run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_core/testing/quantile.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/testing/textured_street.hpp"

namespace swf_vo::bench {

using urban_nav_core::ImageView;
using urban_nav_core::Pose;
using urban_nav_core::testing::quantile;

std::string dataFolder(const std::string& name) {
  const char* root = std::getenv("URBAN_NAV_DATA");
  std::string folder = root == nullptr ? "" : std::string(root) + "/stereo/" + name;
  if (!folder.empty() && std::filesystem::exists(folder)) return folder;
  std::cerr << "left out: " << name << " is not below URBAN_NAV_DATA/stereo\n";
  return {};
}

Sequence kittiFolder(const std::string& folder, std::size_t frames) {
  Sequence sequence;
  sequence.name = std::filesystem::path(folder).filename();
  sequence.stamps = urban_nav_core::readTimes(folder + "/times.txt");
  if (sequence.stamps.size() > frames) sequence.stamps.resize(frames);
  if (std::filesystem::exists(folder + "/poses.txt")) sequence.truth = urban_nav_core::readKitti(folder + "/poses.txt");
  if (sequence.truth.size() > sequence.stamps.size()) sequence.truth.resize(sequence.stamps.size());
  const auto path = [folder](int camera, std::size_t frame) {
    char name[64];
    std::snprintf(name, sizeof name, "/image_%d/%06zu.png", camera, frame);
    return folder + name;
  };
  sequence.read = [path](std::size_t frame, cv::Mat& left, cv::Mat& right) {
    left = cv::imread(path(0, frame), cv::IMREAD_GRAYSCALE);
    right = cv::imread(path(1, frame), cv::IMREAD_GRAYSCALE);
  };
  const cv::Mat first = cv::imread(path(0, 0), cv::IMREAD_GRAYSCALE);
  sequence.camera = urban_nav_core::readKittiCalibration(folder + "/calib.txt", first.cols, first.rows);
  return sequence;
}

std::vector<Sequence> renderedAt(const std::vector<double>& noises, const RenderedOptions& options) {
  using namespace urban_nav_core::testing;
  SequenceOptions how;
  how.camera = options.camera;
  how.rate = options.rate;
  how.seed = options.seed;
  const Scene scene = options.scene == "street" ? texturedStreet({}, options.seed) : texturedRoom({}, options.seed);
  const auto source =
      std::make_shared<RenderedSequence>(scene, namedMotion(options.motion, options.scene, options.seed), how);
  Sequence sequence;
  sequence.name = options.scene + ", " + options.motion + ", seed " + std::to_string(options.seed);
  const auto& c = options.camera;
  sequence.camera = {{c.fx, c.fy, c.cx, c.cy, c.width, c.height}, c.baseline};
  const Pose first = source->T_world_camera(0);
  for (std::size_t i = 0; i < options.frames; ++i) {
    sequence.stamps.push_back(source->stamp(static_cast<int>(i)));
    sequence.truth.push_back(first.inverse() * source->T_world_camera(static_cast<int>(i)));
  }
  std::vector<Sequence> sequences(noises.size(), sequence);
  for (std::size_t n = 0; n < noises.size(); ++n)
    sequences[n].read = [source, noise = noises[n]](std::size_t frame, cv::Mat& left, cv::Mat& right) {
      const StereoFrame& drawn = source->frame(static_cast<int>(frame), noise);
      const auto copy = [](const GreyImage& image, cv::Mat& to) {
        to.create(image.height, image.width, CV_8UC1);
        std::copy(image.pixels.begin(), image.pixels.end(), to.data);
      };
      copy(drawn.left, left);
      copy(drawn.right, right);
    };
  return sequences;
}

Sequence rendered(const RenderedOptions& options) { return renderedAt({options.noise}, options).front(); }

Parameters parametersFrom(const std::vector<std::string>& settings) {
  std::vector<urban_nav_core::Assignment> assignments;
  assignments.reserve(settings.size());
  for (const std::string& setting : settings) assignments.push_back(urban_nav_core::parseSetting(setting));
  urban_nav_core::refuseUnknownStages(assignments, {table().stage()});
  return urban_nav_core::load(table(), assignments).parameters;
}

namespace {

ImageView view(const cv::Mat& image) {
  return image.empty() ? ImageView()
                       : ImageView{image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

void take(const std::vector<Settled>& settled, Run& run) {
  for (const Settled& one : settled) {
    run.settled.push_back(one.T_odom_base.pose);
    run.settled_covariance.push_back(one.T_odom_base.covariance);
    run.relative_covariance.push_back(one.from_previous.covariance);
    run.drift_covariance.push_back(one.from_previous.drift_covariance);
  }
}

}  // namespace

std::vector<Run> runTogether(const std::vector<Sequence>& sequences, const Parameters& parameters,
                             const Ablation& ablation) {
  std::vector<Run> results(sequences.size());
  std::vector<SwfVo> filters;
  filters.reserve(sequences.size());
  for (const Sequence& sequence : sequences)
    filters.push_back(makeAblated(ablation, parameters, sequence.camera, Pose()));
  cv::Mat left, right;
  for (std::size_t i = 0; i < sequences.front().stamps.size(); ++i)
    for (std::size_t s = 0; s < sequences.size(); ++s) {
      Run& result = results[s];
      sequences[s].read(i, left, right);
      const double start = urban_nav_core::testing::threadMs();
      const Frame& frame = filters[s].process({sequences[s].stamps[i], view(left), view(right)});
      result.ms.push_back(urban_nav_core::testing::threadMs() - start);
      result.now.push_back(frame.T_odom_base.pose);
      result.now_covariance.push_back(frame.T_odom_base.covariance);
      result.statistics.push_back(frame.statistics);
      result.status.push_back(frame.status);
      take(frame.settled, result);
    }
  for (std::size_t s = 0; s < sequences.size(); ++s) take(filters[s].flush(), results[s]);
  return results;
}

Run run(const Sequence& sequence, const Parameters& parameters, const Ablation& ablation) {
  return std::move(runTogether({sequence}, parameters, ablation).front());
}

SpanErrors spanErrors(const std::vector<Pose>& truth, const std::vector<Pose>& estimate, std::size_t span) {
  SpanErrors sum;
  int count = 0;
  for (std::size_t i = 0; i + span < std::min(truth.size(), estimate.size()); ++i) {
    double length = 0.0;
    for (std::size_t j = i; j < i + span; ++j) length += distanceBetween(truth[j], truth[j + 1]);
    if (length < 0.005 * static_cast<double>(span)) continue;  // at rest: no percentage
    const Pose error = (truth[i].inverse() * truth[i + span]).inverse() * (estimate[i].inverse() * estimate[i + span]);
    sum.percent += 100.0 * error.t().norm() / length;
    sum.deg_per_m += angleBetween(Pose(), error) * 180.0 / M_PI / length;
    ++count;
  }
  if (count == 0) return {};
  return {sum.percent / count, sum.deg_per_m / count};
}

double stepRatio(const std::vector<Pose>& truth, const std::vector<Pose>& estimate) {
  std::vector<double> ratios;
  for (std::size_t i = 1; i < std::min(truth.size(), estimate.size()); ++i) {
    const double step = distanceBetween(truth[i - 1], truth[i]);
    if (step > 0.05) ratios.push_back(distanceBetween(estimate[i - 1], estimate[i]) / step);
  }
  return quantile(ratios, 0.5);
}

}  // namespace swf_vo::bench
