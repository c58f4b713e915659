// SPDX-License-Identifier: BSD-3-Clause
// The marginal is the Schur complement of the batch at one set of linearisation points, and the unobservable directions
// have no information (section 2.2).
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "urban_nav_core/geometry/dense.hpp"
#include "window/filter.hpp"
#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

using Eigen::MatrixXd;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

using Block = std::pair<bool, std::int64_t>;  // is a pose, frame or landmark

struct Point {
  Anchor anchor;
  Eigen::Vector3d theta;
};

// J^T W J of all terms among the given blocks, by plain products, and the rows of each block.
struct Batch {
  std::vector<Block> order;
  std::map<Block, Eigen::Index> row;
  MatrixXd information;

  void add(const Block& block) {
    row[block] = order.empty() ? 0 : row[order.back()] + (order.back().first ? 6 : 3);
    order.push_back(block);
  }
  Eigen::Index size() const { return order.empty() ? 0 : row.at(order.back()) + (order.back().first ? 6 : 3); }
};

void addSensor(Batch& batch, const SensorModel& model, const Point& point, const Block& landmark, const Pose& pose,
               const Block& frame, const Eigen::Matrix3d& W) {
  SensorModel::Linearised at;
  ASSERT_TRUE(model.linearise(point.anchor, point.theta, PoseMatrices(pose), at));
  const Eigen::Index p = batch.row.at(frame), m = batch.row.at(landmark);
  batch.information.block(p, p, 6, 6) += at.pose().transpose() * W * at.pose();
  batch.information.block(m, m, 3, 3) += at.landmark.transpose() * W * at.landmark;
  batch.information.block(p, m, 6, 3) += at.pose().transpose() * W * at.landmark;
  batch.information.block(m, p, 3, 6) += at.landmark.transpose() * W * at.pose();
}

void addProcess(Batch& batch, const Pose& last, const Block& last_frame, const Pose& next, const Block& next_frame,
                const ProcessInput& u) {
  const auto at = process_model::residual(last, next, u.T_from_to);
  const Matrix6d W = u.information + process_model::floor();
  const Eigen::Index l = batch.row.at(last_frame), n = batch.row.at(next_frame);
  batch.information.block(l, l, 6, 6) += at.last.transpose() * W * at.last;
  batch.information.block(n, n, 6, 6) += at.next.transpose() * W * at.next;
  batch.information.block(l, n, 6, 6) += at.last.transpose() * W * at.next;
  batch.information.block(n, l, 6, 6) += at.next.transpose() * W * at.last;
}

// Eliminates the first `count` rows successively.
MatrixXd schur(MatrixXd A, Eigen::Index count) {
  for (Eigen::Index j = 0; j < count; ++j) {
    const Eigen::Index rest = A.rows() - j - 1;
    const Eigen::VectorXd column = A.col(j).tail(rest);
    A.bottomRightCorner(rest, rest).noalias() -= column * (column.transpose() / A(j, j));
  }
  return A.bottomRightCorner(A.rows() - count, A.rows() - count);
}

// Prior and active terms of a filter at its linearisation points, in the order of its prior, then newer poses, then
// free landmarks.
Batch windowInformation(const Filter& filter, const SensorModel& model) {
  const State& state = filter.state();
  const Prior& prior = filter.prior();
  Batch batch;
  for (const int slot : prior.slots) batch.add({false, state.landmarks[static_cast<std::size_t>(slot)].id});
  for (const PoseBlock& pose : state.poses) batch.add({true, pose.frame});
  for (const LandmarkBlock& landmark : state.landmarks)
    if (landmark.used && landmark.prior < 0 && !landmark.seen.empty()) batch.add({false, landmark.id});
  batch.information = MatrixXd::Zero(batch.size(), batch.size());
  for (int j = 0; j < prior.size(); ++j)
    for (int i = j; i < prior.size(); ++i) batch.information(i, j) = batch.information(j, i) = prior.information(i, j);
  for (const LandmarkBlock& landmark : state.landmarks) {
    if (!landmark.used) continue;
    for (const Measurement& measurement : landmark.seen) {
      const PoseBlock& pose = state.poses[static_cast<std::size_t>(measurement.step - state.first_step)];
      addSensor(batch, model, {landmark.anchor, landmark.linearised}, {false, landmark.id}, pose.linearised,
                {true, pose.frame}, measurement.information);
    }
  }
  for (std::size_t j = 1; j < state.poses.size(); ++j)
    addProcess(batch, state.poses[j - 1].linearised, {true, state.poses[j - 1].frame}, state.poses[j].linearised,
               {true, state.poses[j].frame}, state.poses[j].u);
  return batch;
}

urban_nav_core::testing::TrackOptions shortTracks(int frames) {
  urban_nav_core::testing::TrackOptions motion;
  motion.seed = 11;
  motion.frames = frames;
  motion.features = 14;
  motion.track_length = 6.0;
  motion.missed = 0.2;
  motion.sigma_px = 0.5;
  return motion;
}

TEST(Information, IsTheSchurComplementOfTheBatch) {
  const auto tracks = urban_nav_core::testing::simulateTracks(shortTracks(30));
  WindowOptions options;
  options.size = 5;
  options.huber = 0.0;
  options.datum_ratio = 1e300;  // a replaced datum would be in the prior, but not in the batch
  Filter filter(options, tracks.camera);
  TrackRunner inputs(tracks, options);
  History history;
  std::vector<SettledPose> settled;
  for (std::size_t i = 0; i < tracks.frames.size(); ++i) {
    if (i == 0) filter.start(0, tracks.frames[0].T_world_camera, inputs.first_information);
    else filter.addPose(static_cast<FrameId>(i), inputs.input(i));
    filter.removePoses(settled, &history);
    for (const Observation& observation : inputs.observations(i)) ASSERT_TRUE(filter.observe(observation));
    for (const auto ended : tracks.frames[i].ended) filter.endLandmark(ended);
    filter.update();
  }
  const SensorModel model(tracks.camera);
  const Batch window = windowInformation(filter, model);

  // The batch over the same blocks, preceded by all marginalised ones, at their linearisation points.
  std::map<std::int64_t, Pose> poses;
  std::map<std::int64_t, Point> points;
  Batch batch;
  for (const History::Row& row : history.rows) {
    if (row.is_pose) poses[row.id] = row.linearised_pose;
    else points[row.id] = {row.anchor, row.linearised_landmark};
    batch.add({row.is_pose, row.id});
  }
  const Eigen::Index left = batch.size();
  for (const PoseBlock& pose : filter.state().poses) poses[pose.frame] = pose.linearised;
  for (const LandmarkBlock& landmark : filter.state().landmarks)
    if (landmark.used) points[landmark.id] = {landmark.anchor, landmark.linearised};
  for (const Block& block : window.order) batch.add(block);
  batch.information = MatrixXd::Zero(batch.size(), batch.size());
  batch.information.block(batch.row.at({true, 0}), batch.row.at({true, 0}), 6, 6) = inputs.first_information;
  int terms = 0;
  for (std::size_t i = 0; i < tracks.frames.size(); ++i) {
    const std::int64_t frame = static_cast<std::int64_t>(i);
    for (const Observation& observation : inputs.observations(i))
      if (points.count(observation.landmark) > 0 && batch.row.count({false, observation.landmark}) > 0) {
        addSensor(batch, model, points[observation.landmark], {false, observation.landmark}, poses[frame],
                  {true, frame}, observation.information);
        ++terms;
      }
    if (i > 0) addProcess(batch, poses[frame - 1], {true, frame - 1}, poses[frame], {true, frame}, inputs.input(i));
  }
  EXPECT_GT(left, 300);
  EXPECT_GT(terms, 350);
  const MatrixXd expected = schur(batch.information, left);
  const Eigen::VectorXd scale = expected.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd difference = scale.asDiagonal() * (window.information - expected) * scale.asDiagonal();
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-9);
}

// Eigenvalues of prior and window after a long run without any absolute information, relative to the largest.
Eigen::VectorXd relativeEigenvalues(bool linearise_first) {
  auto motion = shortTracks(1000);
  motion.motion = urban_nav_core::testing::TrackMotion::Mixed;
  motion.features = 10;
  const auto tracks = urban_nav_core::testing::simulateTracks(motion);
  WindowOptions options;
  options.size = 4;
  options.linearise_first = linearise_first;
  TrackRunner run(tracks, options);
  run.first_information.setZero();
  while (!run.done()) run.step();
  EXPECT_LT(urban_nav_core::distanceBetween(run.window.newest().pose, run.truth()), 10.0);
  const Batch window = windowInformation(run.window.filter(), SensorModel(tracks.camera));
  const auto values = urban_nav_core::symmetricEigenvalues(window.information);
  EXPECT_TRUE(values.has_value());
  return *values / values->tail<1>()[0];
}

TEST(Information, StaysEmptyInTheSixDirectionsOfTheGauge) {
  const Eigen::VectorXd values = relativeEigenvalues(true);
  EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT(values[6], 1e-9) << "and no more than six";
}

TEST(Information, OfTheTextbookFillsThem) { EXPECT_GT(relativeEigenvalues(false)[3], 1e-9); }

}  // namespace
}  // namespace swf_vo
