// SPDX-License-Identifier: BSD-3-Clause
#include "map/trajectory_files.hpp"

#include "urban_nav_core/io/covariance_csv.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"

namespace urban_nav {

using urban_nav_core::Pose;

namespace {

/// One session of a map.
struct MapMember {
  const SessionOdometry* run;
  const SessionTrajectory* session;
};

std::string trajectoryTum(const std::vector<MapMember>& members) {
  std::string text;
  for (const auto& [run, session] : members)
    text += urban_nav_core::printTum(session->localized ? *session->localized : session->T_map_base);
  return text;
}

/// Appends a line per stereo frame; a dropped frame repeats the previous line.
void appendKitti(std::vector<Pose>& lines, const MapMember& member, const Pose& T_first_map) {
  const urban_nav_core::Trajectory& trajectory = member.session->T_map_base;
  std::size_t next = 0;
  for (const OdometryFrame& row : member.run->frames) {
    if (row.accepted || next == 0) {
      if (next >= trajectory.size()) return;
      lines.push_back(T_first_map * trajectory[next++].pose * member.run->T_base_camera);
    } else {
      lines.push_back(lines.back());
    }
  }
}

std::string trajectoryKitti(const std::vector<MapMember>& members) {
  const MapMember& first = members.front();
  const Pose T_first_map = (first.session->T_map_base.front().pose * first.run->T_base_camera).inverse();
  std::vector<Pose> lines;
  for (const MapMember& member : members) appendKitti(lines, member, T_first_map);
  return urban_nav_core::printKitti(lines);
}

std::string covarianceCsv(const std::vector<MapMember>& members) {
  std::string text = urban_nav_core::covarianceHeader();
  for (const auto& [run, session] : members)
    for (std::size_t i = 0; i < session->covariances.size(); ++i)
      text += urban_nav_core::printCovarianceRow(urban_nav_core::CovarianceRow{
          session->T_map_base[i].stamp, run->settled[i].status.health, session->covariances[i]});
  return text;
}

std::string relativeCovarianceCsv(const std::vector<MapMember>& members) {
  std::string text = urban_nav_core::relativeCovarianceHeader();
  for (const auto& [run, session] : members)
    for (std::size_t i = 1; i < run->settled.size(); ++i) {
      const urban_nav_core::RelativePose& step = run->settled[i].from_previous;
      text += urban_nav_core::printCovarianceRow(
          urban_nav_core::RelativeCovarianceRow{step.from, step.to, run->settled[i].status.health, step.covariance});
    }
  return text;
}

std::string withSuffix(std::string name, std::size_t session) {
  return name.replace(name.find('#'), 1, fileSuffix(session));
}

}  // namespace

const std::vector<std::string>& trajectoryFileNames() {
  static const std::vector<std::string> names = {"trajectory#.tum", "trajectory#.kitti", "covariance#.csv",
                                                 "relative_covariance#.csv"};
  return names;
}

std::vector<OutputFile> trajectoryFiles(const std::vector<const SessionOdometry*>& runs,
                                        const std::vector<SessionTrajectory>& trajectories) {
  using Printer = std::string (*)(const std::vector<MapMember>&);
  static constexpr Printer kPrinters[] = {trajectoryTum, trajectoryKitti, covarianceCsv, relativeCovarianceCsv};
  std::vector<OutputFile> files;
  for (std::size_t first = 0; first < trajectories.size(); ++first) {
    if (!trajectories[first].written) continue;
    std::vector<MapMember> members;
    for (std::size_t s = first; s < trajectories.size(); ++s)
      if (trajectories[s].map == first && !trajectories[s].T_map_base.empty())
        members.push_back({runs[s], &trajectories[s]});
    for (std::size_t i = 0; i < trajectoryFileNames().size(); ++i) {
      OutputFile file{withSuffix(trajectoryFileNames()[i], first), {}};
      if (!members.empty()) file.content = [members, print = kPrinters[i]] { return print(members); };
      files.push_back(std::move(file));
    }
  }
  return files;
}

}  // namespace urban_nav
