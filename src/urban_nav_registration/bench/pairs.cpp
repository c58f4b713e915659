// SPDX-License-Identifier: BSD-3-Clause
// Stereo closures of pairs of views by their distance: acceptance, errors, consistency of the information (NEES;
// expected 6), and processor time; compared with OpenCV on the same pairs. Also verdicts of pairs of different places.
//   urban_nav_registration-bench-pairs FOLDER... [--false N] [--no-peers] [--draw DIR] [--list]
//     [--set registration.NAME=VALUE]... [-o results/pairs.json]
// FOLDER: frames in KITTI's layout with poses.txt, in any order, of any number of days, such as
// urban_nav_sim-bench-revisits makes.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "support/opencv_pnp.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_core/testing/quantile.hpp"
#include "urban_nav_core/testing/sequence_folder.hpp"
#include "urban_nav_core/trajectory/nees.hpp"
#include "urban_nav_registration/keyframe/keyframe_extractor.hpp"
#include "urban_nav_registration/pictures/match_picture.hpp"
#include "urban_nav_registration/stereo/stereo_closure.hpp"

namespace {

using namespace urban_nav_registration;
using urban_nav_core::Pose;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::processMs;
using urban_nav_core::testing::quantile;
using urban_nav_core::testing::Recording;

struct Options {
  std::vector<std::string> folders, sets;
  std::string draw, output;
  std::size_t false_pairs = 500;
  bool peers = true, list = false;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--false" && i + 1 < argc) options.false_pairs = static_cast<std::size_t>(std::stoi(argv[++i]));
    else if (word == "--draw" && i + 1 < argc) options.draw = argv[++i];
    else if (word == "--set" && i + 1 < argc) options.sets.push_back(argv[++i]);
    else if (word == "-o" && i + 1 < argc) options.output = argv[++i];
    else if (word == "--no-peers") options.peers = false;
    else if (word == "--list") options.list = true;
    else options.folders.push_back(word);
  }
  return options;
}

constexpr double kElsewhereM = 40.0;  // minimum distance of different places
constexpr double kDegrees = 57.29577951308232;

constexpr double kWrongM = 0.5, kWrongDeg = 3.0;  // beyond, a transform is wrong rather than inaccurate
constexpr std::size_t kPeersEvery = 3;            // every third pair, since the peers are slow

struct Outcome {
  double metres = 0.0, deg = 0.0, nees = 0.0;
};

struct Tally {
  std::size_t pairs = 0;
  std::vector<Outcome> upgraded;
  std::vector<double> ms;

  void see(const std::optional<Pose>& T_a_b, const urban_nav_core::Matrix6d* information, const Pose& truth,
           double taken) {
    ++pairs;
    ms.push_back(taken);
    if (!T_a_b) return;
    Outcome outcome{urban_nav_core::distanceBetween(*T_a_b, truth),
                    kDegrees * urban_nav_core::angleBetween(*T_a_b, truth), 0.0};
    if (information != nullptr) {
      const urban_nav_core::Vector6d d = urban_nav_core::boxMinus(truth, *T_a_b);
      outcome.nees = d.dot(*information * d);
    }
    upgraded.push_back(outcome);
  }
  std::vector<double> of(double Outcome::*member) const {
    std::vector<double> values;
    for (const Outcome& outcome : upgraded) values.push_back(outcome.*member);
    return values;
  }
  std::string share() const {
    const auto wrong = std::count_if(upgraded.begin(), upgraded.end(),
                                     [](const Outcome& one) { return one.metres > kWrongM || one.deg > kWrongDeg; });
    return pairs == 0 ? "-"
                      : cell(100.0 * static_cast<double>(upgraded.size()) / static_cast<double>(pairs), 0) + " % (" +
                            std::to_string(wrong) + ")";
  }
  /// Returns the median and the 95 % quantile.
  std::string spread(double Outcome::*member, double unit, int decimals) const {
    if (upgraded.empty()) return "-";
    return cell(unit * quantile(of(member), 0.5), decimals) + " (" + cell(unit * quantile(of(member), 0.95), decimals) +
           ")";
  }
  std::string consistency() const {
    if (upgraded.empty()) return "-";
    double mean = 0.0;
    for (const Outcome& one : upgraded) mean += one.nees / static_cast<double>(upgraded.size());
    return cell(mean, 1) + " (" + cell(quantile(of(&Outcome::nees), 0.5), 1) + ")";
  }
  std::string time() const { return pairs == 0 ? "-" : cell(quantile(ms, 0.5), 0); }
};

/// Adds a row with our results and those of the peers.
void addRow(BenchTable& table, const std::string& where, const std::string& which, const Tally& ours, const Tally& sift,
            const Tally& orb, bool is_one_place = true) {
  if (ours.pairs == 0) return;
  const auto error = [is_one_place](const Tally& tally) {
    return is_one_place ? tally.spread(&Outcome::metres, 100.0, 1) : "-";
  };
  table.add({where, which, std::to_string(ours.pairs), ours.share(), error(ours),
             is_one_place ? ours.spread(&Outcome::deg, 1.0, 2) : "-", is_one_place ? ours.consistency() : "-",
             ours.time(), sift.share(), error(sift), sift.time(), orb.share(), error(orb), orb.time()});
}

struct Class {
  const char* name;
  double least_m, most_m, least_deg, most_deg;
};
constexpr std::array<Class, 6> kClasses = {{{"up to 1 m, turned by less than 20 deg", 0.0, 1.0, 0.0, 20.0},
                                            {"1 to 2 m", 1.0, 2.0, 0.0, 20.0},
                                            {"2 to 4 m", 2.0, 4.0, 0.0, 20.0},
                                            {"4 to 7.5 m", 4.0, 7.5, 0.0, 20.0},
                                            {"up to 4 m, turned by 20 to 30 deg", 0.0, 4.0, 20.0, 30.0},
                                            {"up to 4 m, turned by 30 to 40 deg", 0.0, 4.0, 30.0, 40.0}}};

const Class* classify(double metres, double deg) {
  for (const Class& one : kClasses)
    if (metres >= one.least_m && metres < one.most_m && deg >= one.least_deg && deg < one.most_deg) return &one;
  return nullptr;
}

class Program {
 public:
  explicit Program(const Options& options) : options_(options) {
    std::vector<urban_nav_core::Assignment> assignments;
    for (const std::string& set : options.sets) assignments.push_back(urban_nav_core::parseSetting(set));
    urban_nav_core::refuseUnknownStages(assignments, {table().stage()});
    parameters_ = urban_nav_core::load(table(), assignments).parameters;
  }

  void run(const std::string& folder, BenchTable& table) {
    const std::string name = folder.substr(folder.find_last_of('/') + 1);
    const Recording recording = urban_nav_core::testing::readSequenceFolder(folder);
    const KeyframeExtractor extractor(recording.camera, parameters_.points);
    std::vector<Keyframe> keyframes;
    std::vector<double> ms, sizes, points;
    for (std::size_t i = 0; i < recording.frames.size(); ++i) {
      const double before = processMs();
      keyframes.push_back(extractor.extract({"", static_cast<urban_nav_core::StampNs>(i)}, recording.frames[i].pair()));
      ms.push_back(processMs() - before);
      sizes.push_back(static_cast<double>(keyframes.back().image.size()) / 1000.0);
      points.push_back(static_cast<double>(keyframes.back().points.size()));
    }
    std::cout << name << ": keyframes " << cell(quantile(ms, 0.5), 1) << " ms, " << cell(quantile(sizes, 0.5), 0)
              << " kB (95 %: " << cell(quantile(sizes, 0.95), 0) << "), " << quantile(points, 0.5)
              << " points (5 %: " << quantile(points, 0.05) << ")\n";
    std::array<Tally, kClasses.size()> ours, sift, orb;
    for (std::size_t i = 0; i < keyframes.size(); ++i)
      for (std::size_t j = i + 1; j < keyframes.size(); ++j) {
        const Pose truth = recording.truth[i].inverse() * recording.truth[j];
        const double metres = truth.t().norm(), deg = kDegrees * urban_nav_core::angleBetween(truth, Pose());
        const Class* kind = classify(metres, deg);
        if (kind == nullptr) continue;
        const auto k = static_cast<std::size_t>(kind - kClasses.data());
        StereoMatcher matcher(recording.camera, parameters_);  // new, so that all processing is included
        const double before = processMs();
        const StereoClosure closure = matcher.match(keyframes[i], keyframes[j]);
        const double taken = processMs() - before + ms[i] + ms[j];
        const bool accepted = closure.verdict == urban_nav_core::ClosureVerdict::Accepted;
        std::optional<Pose> T_a_b;
        if (accepted) T_a_b = closure.lefts.T_a_b;
        ours[k].see(T_a_b, &closure.lefts.information, truth, taken);
        if (options_.list) list(name, i, j, truth, closure);
        draw(name, keyframes[i], keyframes[j], closure);
        if (!options_.peers || ours[k].pairs % kPeersEvery != 1) continue;
        for (const bench::Feature feature : {bench::Feature::Sift, bench::Feature::Orb}) {
          const double start = processMs();
          const auto pose =
              bench::poseByOpenCv(feature, recording.camera, recording.frames[i].pair(), recording.frames[j].pair());
          (feature == bench::Feature::Sift ? sift : orb)[k].see(pose, nullptr, truth, processMs() - start);
        }
      }
    for (std::size_t k = 0; k < kClasses.size(); ++k) addRow(table, name, kClasses[k].name, ours[k], sift[k], orb[k]);
    falsePairs(name, recording, keyframes, table);
  }

 private:
  void draw(const std::string& name, const Keyframe& a, const Keyframe& b, const StereoClosure& closure) const {
    if (options_.draw.empty()) return;
    MatchPictureOptions options;
    options.title_a = std::to_string(a.at.stamp);
    options.title_b = std::to_string(b.at.stamp);
    options.caption = std::string(toString(closure.verdict)) + ": " + closure.sentence;
    const std::vector<std::uint8_t> bytes = encodeJpeg(drawMatches(a, b, closure.pixels, options));
    urban_nav_core::writeAtomically(options_.draw + "/" + name + "_" + options.title_a + "_" + options.title_b + ".jpg",
                                    std::string(bytes.begin(), bytes.end()));
  }

  /// Returns the error of each coordinate over its standard deviation.
  static std::string whitened(const StereoClosure& closure, const urban_nav_core::Vector6d& d) {
    const auto covariance = urban_nav_core::invertPositiveDefinite(closure.lefts.information);
    std::string text;
    for (int i = 0; covariance && i < 6; ++i) text += cell(d[i] / std::sqrt((*covariance)(i, i)), 1) + " ";
    return text;
  }

  static std::string raw(const urban_nav_core::Vector6d& d) {
    std::string text;
    for (int i = 0; i < 6; ++i) text += cell(1e3 * d[i], 3) + " ";
    return text;
  }

  static void list(const std::string& name, std::size_t i, std::size_t j, const Pose& truth,
                   const StereoClosure& closure) {
    const urban_nav_core::Vector6d d = urban_nav_core::boxMinus(truth, closure.lefts.T_a_b);
    std::printf(
        "%s %zu %zu: %.2f m %.1f deg | put %d con %d vis %d match %d like %.3f err %.3f px noise %.2f | %s | %.1f cm "
        "%.3f deg nees %.1f | %s\n",
        name.c_str(), i, j, truth.t().norm(), kDegrees * urban_nav_core::angleBetween(truth, Pose()), closure.putative,
        closure.consensus, closure.visible, closure.matches, closure.likeness, closure.reprojection_px,
        closure.noise_factor, toString(closure.reason), 100.0 * d.head<3>().norm(), kDegrees * d.tail<3>().norm(),
        d.dot(closure.lefts.information * d), (whitened(closure, d) + "# " + raw(d)).c_str());
  }

  void falsePairs(const std::string& name, const Recording& recording, const std::vector<Keyframe>& keyframes,
                  BenchTable& table) const {
    urban_nav_core::testing::Dice dice(1);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t tried = 0; tried < 50 * options_.false_pairs && pairs.size() < options_.false_pairs; ++tried) {
      const std::size_t i = dice.below(keyframes.size()), j = dice.below(keyframes.size());
      if (urban_nav_core::distanceBetween(recording.truth[i], recording.truth[j]) > kElsewhereM)
        pairs.emplace_back(i, j);
    }
    if (pairs.empty()) return;
    Tally tally;
    double largest_correlation = 0.0;
    int most_matches = 0;
    StereoMatcher matcher(recording.camera, parameters_);
    for (const auto& [i, j] : pairs) {
      const double before = processMs();
      const StereoClosure closure = matcher.match(keyframes[i], keyframes[j]);
      const bool accepted = closure.verdict == urban_nav_core::ClosureVerdict::Accepted;
      const Pose truth = recording.truth[i].inverse() * recording.truth[j];
      std::optional<Pose> T_a_b;
      if (accepted) T_a_b = closure.lefts.T_a_b;
      tally.see(T_a_b, nullptr, truth, processMs() - before);
      if (closure.matches >= parameters_.min_matches)
        largest_correlation = std::max(largest_correlation, closure.likeness);
      most_matches = std::max(most_matches, closure.matches);
      if (options_.list && (accepted || closure.matches > 20)) list(name + " FALSE", i, j, truth, closure);
      if (accepted) draw(name + "_false", keyframes[i], keyframes[j], closure);
    }
    std::cout << name << ": of " << pairs.size() << " false pairs " << tally.upgraded.size()
              << " accepted; most matches " << most_matches << ", largest likeness of those with enough "
              << cell(largest_correlation, 2) << "\n";
    addRow(table, name, "another place", tally, {}, {}, false);
  }

  Options options_;
  Parameters parameters_;
};

}  // namespace

int main(int argc, char** argv) try {
  const Options options = parse(argc, argv);
  BenchTable table({"frames", "pairs", "count", "upgraded (wrong)", "error, cm: median (95 %)", "deg: median (95 %)",
                    "NEES: mean (median)", "ms", "OpenCV, SIFT: upgraded (wrong)", "cm", "ms",
                    "OpenCV, ORB: upgraded (wrong)", "cm", "ms"},
                   argc, argv);
  table.note(
      "Wrong: off by more than half a metre or 3 deg; of pairs of different places, all that are accepted. NEES: 6 is "
      "expected, with a median of 5.3. Time: one core, from the images of both keyframes to the verdict. OpenCV on "
      "every third pair: 500 features, ratio test, depth by StereoSGBM, solvePnPRansac and solvePnPRefineLM, 50 "
      "inliers required.");
  Program program(options);
  for (const std::string& folder : options.folders) program.run(folder, table);
  std::cout << table.text();
  if (!options.output.empty()) table.write(options.output);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
