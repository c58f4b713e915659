// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/simulate.hpp"

#include <filesystem>
#include <optional>

#include "base/console.hpp"
#include "base/held_signals.hpp"
#include "simulate/session_bags.hpp"
#include "simulate/stereo_folder_writer.hpp"
#include "simulate/view_writer.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace urban_nav {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kFramePeriod = 50'000'000;  // ns, of the stereo camera, by which progress is reported

std::string toTruthFolder(const std::string& bag) { return fs::path(bag).replace_extension(".truth").string(); }

void makeFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw urban_nav_core::UserError(path, "cannot be made: " + error.message(), "");
}

}  // namespace

Simulated simulate(const SimulateJob& job, Console& console) {
  const HeldSignals signals;
  urban_nav_sim::Session session(job.session);
  const urban_nav_core::Pose T_base_left = session.places().at(urban_nav_core::frames::kStereoLeft);
  std::vector<std::string> frames;
  for (const auto& [frame, T_base_sensor] : session.places()) frames.push_back(frame);
  SessionBags bags(job.bag, job.part, session, parseCalibrationErrors(job.lags, job.misplaced, frames));
  std::optional<StereoFolderWriter> folder;
  if (!job.folder.empty()) folder.emplace(job.folder, session);
  Simulated made;
  made.truth_folder = toTruthFolder(job.bag);
  makeFolder(made.truth_folder);
  ViewWriter views(made.truth_folder);

  Progress progress(console, "simulate", "frames", session.frames());
  std::optional<urban_nav_core::Pose> last;
  while (const std::optional<urban_nav_sim::Session::Arrival> arrival = session.next()) {
    signals.check();
    bags.write(arrival->measurement, arrival->taken);
    if (const auto* pair = std::get_if<urban_nav_sim::StereoMeasurement>(&arrival->measurement); pair && folder)
      folder->add(*pair, session.truth(arrival->taken) * T_base_left);
    if (const auto* truth = std::get_if<urban_nav_sim::TruthMeasurement>(&arrival->measurement)) {
      if (last) made.distance_m += distanceBetween(*last, truth->T_world_base);
      last = truth->T_world_base;
    }
    if (const auto* view = std::get_if<urban_nav_sim::ViewTruth>(&arrival->measurement)) views.add(*view);
    progress.update((arrival->taken - session.begin()) / kFramePeriod);
  }
  progress.finish(session.frames());
  console.info("truth: " + made.truth_folder);
  session.writeTruth(made.truth_folder, job.false_closures);
  views.finish();
  signals.check();
  if (folder) folder->finish();
  bags.commit();
  made.bags = bags.paths();
  if (const std::string old = bags.leftover(); !old.empty())
    console.warn(old + " is from a previous session, not a part of this one");
  made.counts = bags.counts();
  return made;
}

}  // namespace urban_nav
