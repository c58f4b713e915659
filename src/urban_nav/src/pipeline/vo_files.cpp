// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/vo_files.hpp"

#include <cstring>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

using swf_vo::Settled;
using urban_nav_core::appendNumber;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

namespace {

constexpr int kLeastSeen = 3;  // frames: what was seen less is as likely a wrong match as a point

void appendMatrix(std::string& text, const Matrix6d& matrix) {
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      text += ',';
      appendNumber(text, matrix(row, column));
    }
  }
}

std::string matrixHeader() {
  std::string text;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) text += ",c" + std::to_string(row) + std::to_string(column);
  }
  return text + "\n";
}

void appendPose(std::string& text, const Pose& pose, char separator) {
  const double values[] = {pose.t().x(), pose.t().y(), pose.t().z(), pose.q().x(), pose.q().y(), pose.q().z(), pose.q().w()};
  for (const double value : values) {
    text += separator;
    appendNumber(text, value);
  }
}

void appendFloat(std::string& bytes, float value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// g2o's perturbation is the vector part of a quaternion (half the angle) behind the measurement, in the axes of the vertex it leads to.
Matrix6d g2oInformation(const Pose& T_from_to, const Matrix6d& covariance) {
  Matrix6d to_local = Matrix6d::Zero();
  to_local.topLeftCorner<3, 3>() = T_from_to.R().transpose();
  to_local.bottomRightCorner<3, 3>() = 0.5 * T_from_to.R().transpose();
  const Matrix6d local = to_local * covariance * to_local.transpose();
  const Matrix6d inverse = local.inverse();
  if (!inverse.allFinite()) return Matrix6d::Zero();
  return 0.5 * (inverse + inverse.transpose());
}

}  // namespace

std::string trajectoryTum(const VoRun& run) {
  std::string text;
  for (const Settled& settled : run.settled) {
    text += urban_nav_core::printStamp(settled.stamp);
    appendPose(text, settled.T_odom_base.pose, ' ');
    text += '\n';
  }
  return text;
}

std::string trajectoryKitti(const VoRun& run) {
  std::string text, line;
  if (run.settled.empty()) return text;
  const Pose T_first_odom = (run.settled.front().T_odom_base.pose * run.T_base_camera).inverse();
  std::size_t next = 0;
  for (const VoRow& row : run.rows) {
    if (row.accepted || line.empty()) {
      if (next >= run.settled.size()) break;
      const Eigen::Matrix4d T = (T_first_odom * run.settled[next++].T_odom_base.pose * run.T_base_camera).matrix();
      line.clear();
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 4; ++j) {
          if (!line.empty()) line += ' ';
          appendNumber(line, T(i, j));
        }
      }
      line += '\n';
    }
    text += line;
  }
  return text;
}

std::string covarianceCsv(const VoRun& run) {
  std::string text = "stamp_ns,status" + matrixHeader();
  for (const Settled& settled : run.settled) {
    text += std::to_string(settled.stamp) + "," + toString(settled.status.health);
    appendMatrix(text, settled.T_odom_base.covariance);
    text += '\n';
  }
  return text;
}

std::string relativeCovarianceCsv(const VoRun& run) {
  std::string text = "stamp_from_ns,stamp_to_ns,status" + matrixHeader();
  for (std::size_t i = 1; i < run.settled.size(); ++i) {
    const urban_nav_core::RelativePose& step = run.settled[i].from_previous;
    text += std::to_string(step.from) + "," + std::to_string(step.to) + "," + toString(run.settled[i].status.health);
    appendMatrix(text, step.covariance);
    text += '\n';
  }
  return text;
}

std::string graphG2o(const VoRun& run) {
  std::string text;
  for (std::size_t i = 0; i < run.settled.size(); ++i) {
    text += "VERTEX_SE3:QUAT " + std::to_string(i);
    appendPose(text, run.settled[i].T_odom_base.pose, ' ');
    text += '\n';
  }
  if (!run.settled.empty()) text += "FIX 0\n";
  for (std::size_t i = 1; i < run.settled.size(); ++i) {
    const urban_nav_core::RelativePose& step = run.settled[i].from_previous;
    text += "EDGE_SE3:QUAT " + std::to_string(i - 1) + " " + std::to_string(i);
    appendPose(text, step.T_from_to, ' ');
    const Matrix6d information = g2oInformation(step.T_from_to, step.covariance);
    for (int row = 0; row < 6; ++row) {
      for (int column = row; column < 6; ++column) {
        text += ' ';
        appendNumber(text, information(row, column));
      }
    }
    text += '\n';
  }
  return text;
}

std::string landmarksPly(const VoRun& run) {
  std::string bytes;
  std::int64_t count = 0;
  for (const auto& [id, landmark] : run.landmarks) {
    if (landmark.seen < kLeastSeen || !landmark.landmark.p_odom.allFinite()) continue;
    for (int i = 0; i < 3; ++i) appendFloat(bytes, static_cast<float>(landmark.landmark.p_odom(i)));
    appendFloat(bytes, landmark.landmark.sigma);
    bytes.append(3, static_cast<char>(landmark.grey));
    ++count;
  }
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float sigma\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n" + bytes;
}

std::string statsCsv(const std::vector<const VoRun*>& runs) {
  std::string text =
      "session,frame,stamp_ns,accepted,status,reason,corners,features,tracked,track_length_mean,reprojection_px,iterations,landmarks,landmarks_in_prior,"
      "now_x,now_y,now_z,now_qx,now_qy,now_qz,now_qw,swf_vo_ms\n";
  for (std::size_t session = 0; session < runs.size(); ++session) {
    for (const VoRow& row : runs[session]->rows) {
      const swf_vo::Statistics& s = row.statistics;
      text += std::to_string(session + 1) + "," + std::to_string(row.frame) + "," + std::to_string(row.stamp) + (row.accepted ? ",1," : ",0,") + toString(row.status.health) + "," +
              swf_vo::toString(static_cast<swf_vo::Reason>(row.status.reason));
      for (const int value : {s.corners, s.features, s.tracked}) text += "," + std::to_string(value);
      for (const double value : {s.track_length_mean, s.reprojection_px}) {
        text += ',';
        appendNumber(text, value);
      }
      for (const int value : {s.iterations, s.landmarks, s.landmarks_in_prior}) text += "," + std::to_string(value);
      appendPose(text, row.T_odom_base, ',');
      text += ',';
      appendNumber(text, row.process_ms);
      text += '\n';
    }
  }
  return text;
}

void writeVoFiles(const OutputFolder& folder, const VoRun& run, const std::string& suffix) {
  folder.write("trajectory" + suffix + ".tum", trajectoryTum(run));
  folder.write("trajectory" + suffix + ".kitti", trajectoryKitti(run));
  folder.write("covariance" + suffix + ".csv", covarianceCsv(run));
  folder.write("relative_covariance" + suffix + ".csv", relativeCovarianceCsv(run));
  folder.write("graph" + suffix + ".g2o", graphG2o(run));
  folder.write("landmarks" + suffix + ".ply", landmarksPly(run));
}

}  // namespace urban_nav
