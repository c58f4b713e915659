// SPDX-License-Identifier: BSD-3-Clause
// Labels of 3D LiDAR sweeps by the default model in simulated drives, along true poses, compared with the true classes;
// processor time of one thread.
//
//   urban_nav-bench-lidar_labels [--seconds S] [--model FILE] [-o FILE.json] [WORLD:ROUTE:SEED:RINGS ...]
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "scene_labeler/sweep/sweep_labeler.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_sim/session.hpp"

namespace {

using scene_labeler::SceneClass;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::testing::cell;

constexpr StampNs kPoseStep = 20'000'000;     // ns
constexpr StampNs kLongestGap = 500'000'000;  // ns
constexpr std::size_t kClasses = 8;           // classes of the simulator
constexpr double kSettled = 5.0;              // s: the cloud of the first sweeps is sparse

struct Place {
  std::string world, route;
  std::uint32_t seed = 1;
  int rings = 16;
};

struct Score {
  std::array<std::array<std::size_t, kClasses>, kClasses> confusion{};  // true class, answer
  std::size_t points = 0, right = 0, sure = 0, sure_right = 0, returns = 0;
  std::vector<double> ms;  // by sweep
  std::size_t cloud = 0, answers = 0;

  void add(SceneClass truth, SceneClass answer, bool is_unsure) {
    const bool is_right = scene_labeler::withOneWall(truth) == scene_labeler::withOneWall(answer);
    ++points;
    right += is_right ? 1U : 0U;
    sure += is_unsure ? 0U : 1U;
    sure_right += !is_unsure && is_right ? 1U : 0U;
    if (toIndex(answer) < kClasses) ++confusion[toIndex(truth)][toIndex(answer)];
  }
  double f1(std::size_t k) const {
    std::size_t stated = 0, truth = 0;
    for (std::size_t i = 0; i < kClasses; ++i) {
      stated += confusion[i][k];
      truth += confusion[k][i];
    }
    return truth == 0 ? -1.0 : 200.0 * static_cast<double>(confusion[k][k]) / static_cast<double>(stated + truth);
  }
};

/// Labels each sweep and compares those that are settled with the truth.
class Drive {
 public:
  Drive(const Place& place, double seconds, const std::shared_ptr<const scene_labeler::LabelModel>& model)
      : session_(options(place, seconds)), labeler_(model, 12) {
    for (StampNs t = 0; t <= static_cast<StampNs>(1e9 * seconds); t += kPoseStep)
      truth_.append(session_.begin() + t, session_.truth(session_.begin() + t));
  }

  Score run() {
    std::map<StampNs, urban_nav_sim::LidarMeasurement> sweeps;
    while (auto arrival = session_.next()) {
      if (auto* lidar = std::get_if<urban_nav_sim::LidarMeasurement>(&arrival->measurement))
        sweeps[lidar->stamp] = std::move(*lidar);
      const auto* view = std::get_if<urban_nav_sim::ViewTruth>(&arrival->measurement);
      if (view == nullptr || sweeps.count(view->stamp) == 0) continue;
      add(sweeps[view->stamp].sweep, *view);
      sweeps.erase(view->stamp);
    }
    score_.cloud = labeler_.cloudSize();
    return score_;
  }

 private:
  static urban_nav_sim::SessionOptions options(const Place& place, double seconds) {
    urban_nav_sim::SessionOptions options;
    options.world = place.world;
    options.route = place.route;
    options.seed = place.seed;
    options.duration = seconds;
    options.sensors = options.views = {urban_nav_sim::Sensor::Lidar3d};
    options.lidar.rings = place.rings;
    return options;
  }

  void add(const urban_nav_core::Sweep& sweep, const urban_nav_sim::ViewTruth& view) {
    const Pose T_base_lidar = session_.places().at(urban_nav_core::frames::kLidar3d);
    urban_nav_core::Scan scan;
    std::vector<urban_nav_core::Beam> beams;
    for (const urban_nav_core::Beam& beam : sweep.beams)
      if (beam.stamp >= truth_.front().stamp && beam.stamp <= truth_.back().stamp) beams.push_back(beam);
    scan.stamp = sweep.reference;
    scan.beams = beams;
    urban_nav_core::BeamRenderer renderer(truth_, T_base_lidar, Pose(), kLongestGap);
    std::vector<urban_nav_core::LaserPoint> points;
    const double begin = urban_nav_core::testing::processMs();
    if (renderer.render(scan, points) > 0 || points.empty()) return;
    const auto labels = labeler_.label(points, points.back().origin);
    score_.ms.push_back(urban_nav_core::testing::processMs() - begin);
    score_.returns += points.size();
    score_.answers += labels.answers.labels.size();
    if (urban_nav_core::secondsBetween(session_.begin(), sweep.reference) < kSettled) return;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::uint32_t row = labels.answer_of_return[i];
      if (row == scene_labeler::SweepLabels::kNoAnswer || beams[i].ring >= view.surface_class.rows ||
          beams[i].column >= view.surface_class.cols)
        continue;
      score_.add(static_cast<SceneClass>(view.surface_class.at<std::uint8_t>(beams[i].ring, beams[i].column)),
                 labels.answers.labels[row], labels.answers.unsure[row] != 0);
    }
  }

  urban_nav_sim::Session session_;
  scene_labeler::SweepLabeler labeler_;
  urban_nav_core::Trajectory truth_;
  Score score_;
};

std::vector<std::string> printScore(const Place& place, Score score) {
  std::sort(score.ms.begin(), score.ms.end());
  double sum = 0.0;
  for (const double ms : score.ms) sum += ms;
  const auto percent = [](std::size_t part, std::size_t all) {
    return cell(100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1)), 1);
  };
  std::string f1;
  for (std::size_t k = 0; k < kClasses; ++k)
    if (score.f1(k) >= 0.0)
      f1 += std::string(f1.empty() ? "" : ", ") + toString(static_cast<SceneClass>(k)) + " " + cell(score.f1(k), 0);
  const double returns = static_cast<double>(std::max<std::size_t>(score.returns, 1));
  return {place.world + " " + std::to_string(place.seed),
          std::to_string(place.rings),
          percent(score.right, score.points),
          percent(score.sure, score.points),
          percent(score.sure_right, score.sure),
          f1,
          score.ms.empty() ? "" : cell(score.ms[score.ms.size() / 2], 0),
          score.ms.empty() ? "" : cell(score.ms[score.ms.size() * 99 / 100], 0),
          cell(1e3 * sum / returns, 2),
          cell(1e3 * sum / static_cast<double>(std::max<std::size_t>(score.answers, 1)), 1)};
}

Place parsePlace(const std::string& word) {
  std::vector<std::string> parts;
  std::istringstream words(word);
  for (std::string part; std::getline(words, part, ':');) parts.push_back(part);
  const auto number = [&](std::size_t i) {
    const auto value = i < parts.size() ? urban_nav_core::parseInteger(parts[i]) : std::nullopt;
    if (!value) throw urban_nav_core::UserError(word, "no drive", "WORLD:ROUTE:SEED:RINGS");
    return *value;
  };
  const auto seed = static_cast<std::uint32_t>(number(2));
  return {parts[0], parts[1], seed, static_cast<int>(number(3))};
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Place> places;
  double seconds = 20.0;
  std::string model = "default", out;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      if (word == "--seconds" && i + 1 < argc) seconds = std::stod(argv[++i]);
      else if (word == "--model" && i + 1 < argc) model = argv[++i];
      else if (word == "-o" && i + 1 < argc) out = argv[++i];
      else places.push_back(parsePlace(word));
    }
    if (places.empty())
      for (const char* world : {"street:loops", "quad:loops"})
        for (const char* rings : {":7:16", ":7:32", ":7:64"}) places.push_back(parsePlace(std::string(world) + rings));
    const auto loaded = std::make_shared<const scene_labeler::LabelModel>(scene_labeler::readModel(model));
    urban_nav_core::testing::BenchTable table(
        {"world, seed", "rings", "right, %", "sure, %", "of these right, %", "F1 by class, %", "ms a sweep, median",
         "99 %", "us a return", "us an answer"},
        argc, argv);
    for (const Place& place : places) {
      urban_nav_core::ThreadLimit one_thread(1);
      table.add(printScore(place, Drive(place, seconds, loaded).run()));
      std::fprintf(stderr, "%s\n", table.text().c_str());
    }
    table.note("Walls of both kinds count as one class in `right`. Returns up to 30 m, from 5 s after the start.");
    std::printf("%s\n", table.text().c_str());
    if (!out.empty()) table.write(out);
  } catch (const urban_nav_core::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
