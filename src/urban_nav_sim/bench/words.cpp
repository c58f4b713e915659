// SPDX-License-Identifier: BSD-3-Clause
// Measures perceptual aliasing: places confused by their visual words, and the share of the words of a place that is
// missing on another day.
//   words [--world NAME] [--places M] [--duration S] [--seed N] [-o FILE.json]
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "camera/heads.hpp"
#include "camera/sky.hpp"
#include "motion/simulate_drive.hpp"
#include "ray_tracing/tracer.hpp"
#include "rig/sensor_poses.hpp"
#include "support/distribution.hpp"
#include "support/places.hpp"
#include "support/program.hpp"
#include "support/vocabulary.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace {

using namespace urban_nav_sim;
using namespace urban_nav_sim::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

constexpr int kWords = 1000;
constexpr double kApart = 25.0;                       // m of driving between places that may be confused
constexpr double kStep = 0.5;                         // m: displacement for comparison with the change of a day
constexpr int kPlacesApart = 4;                       // every n-th place is revisited
constexpr std::array<int, 3> kOtherDays = {2, 3, 4};  // dry; wet; in winter

/// The world on one day, rendered from poses of a motion.
class Scene {
 public:
  Scene(const std::string& name, std::uint32_t seed, int day)
      : world_(buildWorld(name, seed, day)), tracer_(world_), sky_(world_.day, seed) {}

  const World& world() const { return world_; }
  /// Returns the descriptors of the left camera. Uses one head per frame, with settled exposure; `chance`: seed of its
  /// noise.
  cv::Mat describe(const Motion& motion, double t, std::uint64_t chance) const {
    StereoHead head(tracer_, sky_, StereoImages::Rectified, sensorPose(urban_nav_core::frames::kStereoLeft), chance);
    return Vocabulary::describe(head.take(motion, t)[0]);
  }

 private:
  World world_;
  Tracer tracer_;
  Sky sky_;
};

std::unique_ptr<Motion> rideThrough(const World& world, std::uint32_t seed, double duration) {
  DriveOptions options;
  options.duration = duration;
  options.seed = seed;
  return simulateDrive(world, makeRoute(world.name, seed, "loops"), options);
}

/// Returns the times (s) at which the robot has driven 0, `every`, 2 `every`, ... m.
std::vector<double> timesEvery(const Motion& motion, double every) {
  std::vector<double> times;
  Eigen::Vector3d last = motion.at(0.0).T_world_base.t();
  double driven = 0.0;
  for (double t = 0.0; t < motion.duration(); t += 0.02) {
    const Eigen::Vector3d here = motion.at(t).T_world_base.t();
    driven += (here - last).norm();
    last = here;
    if (driven >= every * static_cast<double>(times.size())) times.push_back(t);
  }
  return times;
}

Vocabulary trained(std::uint32_t seed) {
  cv::Mat descriptors;
  for (const std::string& name : townNames()) {
    const Scene scene(name, seed, 1);
    const auto motion = rideThrough(scene.world(), seed, 300.0);
    for (const double t : timesEvery(*motion, 15.0)) descriptors.push_back(scene.describe(*motion, t, seed));
  }
  return Vocabulary(descriptors, kWords);
}

std::string percent(double share) { return cell(100.0 * share, 0); }
std::string percent(int part, int whole) { return whole > 0 ? percent(static_cast<double>(part) / whole) : "-"; }

/// A motion on day 1, and the recognition of its places when revisited.
class Repetition {
 public:
  Repetition(const std::string& name, const Vocabulary& vocabulary, const Options& options)
      : name_(name),
        seed_(static_cast<std::uint32_t>(options.number("--seed", 7))),
        vocabulary_(vocabulary),
        first_(name, seed_, 1),
        motion_(rideThrough(first_.world(), seed_, options.number("--duration", 300))),
        every_(options.number("--places", 3)),
        times_(timesEvery(*motion_, every_)),
        finely_(timesEvery(*motion_, kStep)) {
    for (const double t : times_) places_.push_back(placeAt(first_, t, seed_));
    for (const Place& place : places_) pictures_.push_back(place.words);
    worth_ = wordWeights(pictures_);
  }

  /// Returns a column of the table.
  std::vector<std::string> column() const {
    const Recognition found = recognise(places_, worth_, kApart);
    std::vector<std::string> cells = {std::to_string(places_.size()), std::to_string(found.revisits),
                                      percent(found.mistaken, found.revisits),
                                      percent(found.taken_for_known, found.new_places)};
    std::vector<std::string> gone, taken;
    const auto again = [&](const Scene& scene, double further) {
      const auto [words, elsewhere] = seenAgain(scene, further);
      gone.push_back(words), taken.push_back(elsewhere);
    };
    again(first_, 0.0), again(first_, kStep);
    for (const int day : kOtherDays) again(Scene(name_, seed_, day), 0.0);
    Values chance;
    for (std::size_t i = 0; i < pictures_.size(); ++i)
      chance.push_back(shareLost(pictures_[i], pictures_[(i + pictures_.size() / 2) % pictures_.size()]));
    gone.push_back(percent(quantile(chance, 0.5)));
    cells.insert(cells.end(), gone.begin(), gone.end());
    cells.insert(cells.end(), taken.begin(), taken.end());
    return cells;
  }

 private:
  Place placeAt(const Scene& scene, double t, std::uint64_t chance) const {
    const urban_nav_core::Pose pose = motion_->at(t).T_world_base;
    const Eigen::Matrix3d R = pose.R();
    const double along = every_ * static_cast<double>(places_.size());
    return {pose.t().head<2>(), std::atan2(R(1, 0), R(0, 0)), along,
            vocabulary_.countWords(scene.describe(*motion_, t, chance))};
  }

  /// For every n-th place: returns the share of its words missing `further` m later, and the number of confusions.
  std::array<std::string, 2> seenAgain(const Scene& scene, double further) const {
    Values gone;
    int taken = 0;
    for (std::size_t i = 0; i + 1 < places_.size(); i += kPlacesApart) {
      const double t = further > 0.0 ? *std::upper_bound(finely_.begin(), finely_.end(), times_[i] + 0.1) : times_[i];
      const Place again = placeAt(scene, t, seed_ + 1);
      gone.push_back(shareLost(pictures_[i], again.words));
      if (nearestIn(places_, again, worth_) == Neighbour::Elsewhere) ++taken;
    }
    return {percent(quantile(gone, 0.5)), percent(taken, static_cast<int>(gone.size()))};
  }

  std::string name_;
  std::uint32_t seed_;
  const Vocabulary& vocabulary_;
  Scene first_;
  std::unique_ptr<Motion> motion_;
  double every_;  // m
  std::vector<double> times_, finely_;
  std::vector<Place> places_;
  std::vector<Counts> pictures_;
  std::vector<double> worth_;
};

std::vector<std::string> namesOfRows() {
  std::vector<std::string> names = {"places", "been there before on the same ride", "... and taken for elsewhere (%)",
                                    "new, and taken for known (%)"};
  const auto add = [&](const std::string& what) {
    names.push_back(what + ", same pose, same day (%)");
    names.emplace_back("... 0.5 m on");
    for (const int day : kOtherDays) names.push_back("... same pose, day " + std::to_string(day));
  };
  add("words gone");
  names.emplace_back("... elsewhere");
  add("taken for elsewhere");
  return names;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options(argc, argv);
  const Vocabulary vocabulary = trained(static_cast<std::uint32_t>(options.number("--seed", 7)) + 1);
  std::vector<std::string> worlds = {options.text("--world", "")};
  if (worlds.front().empty()) worlds = townNames();
  std::vector<std::string> columns = {""};
  columns.insert(columns.end(), worlds.begin(), worlds.end());
  std::vector<std::vector<std::string>> rows;
  for (const std::string& name : namesOfRows()) rows.push_back({name});
  for (const std::string& world : worlds) {
    const std::vector<std::string> cells = Repetition(world, vocabulary, options).column();
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(cells[i]);
  }
  BenchTable table(columns, argc, argv);
  for (const auto& row : rows) table.add(row);
  table.note(
      "1 000 words of SIFT by BOWKMeansTrainer, trained on day 1 of all worlds with another seed. Taken for: nearest "
      "neighbour by tf-idf, on the same drive among places at least 25 m of driving earlier, otherwise among all of "
      "day 1 that are not within 1 m; the same place is within 5 m and 46 deg, another one beyond 10 m. Taken for "
      "known: more similar to another place than half of the revisits are to their own. Words gone: of those in the "
      "left image of day 1, median over every fourth place. Day 3 is wet, on day 4 the leaves are down.");
  return show(table, options);
} catch (const std::exception& error) {
  return urban_nav_sim::bench::complain(error);
}
