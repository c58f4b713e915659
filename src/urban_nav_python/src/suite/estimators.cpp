// SPDX-License-Identifier: BSD-3-Clause
#include "suite/estimators.hpp"

#include <pybind11/stl.h>

#include <map>
#include <memory>

#include "errors.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/parameters.hpp"
#include "pose_graph/robust.hpp"
#include "suite/arrays.hpp"
#include "swf_vo/swf_vo.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/stereo_calibration.hpp"

namespace py = pybind11;

namespace urban_nav_python {
namespace {

using urban_nav_core::CameraInfo;
using urban_nav_core::ImageView;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::UserError;
using Pixels = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

template <typename Parameters>
Parameters readParameters(const urban_nav_core::Table<Parameters>& table, const std::vector<std::string>& settings) {
  std::vector<urban_nav_core::Assignment> assignments;
  for (const std::string& setting : settings)
    assignments.push_back(urban_nav_core::parseSetting(table.stage() + "." + setting));
  return urban_nav_core::load(table, assignments).parameters;
}

CameraInfo readCameraInfo(const py::dict& values, const std::string& where) {
  CameraInfo info;
  info.width = values["width"].cast<int>();
  info.height = values["height"].cast<int>();
  info.distortion_model = values["distortion_model"].cast<std::string>();
  info.D = values["D"].cast<std::vector<double>>();
  const auto read = [&](const char* name, auto& matrix) {
    const auto numbers = values[name].cast<std::vector<double>>();
    if (numbers.size() != static_cast<std::size_t>(matrix.size()))
      throw UserError(where, std::string(name) + " has " + std::to_string(numbers.size()) + " numbers",
                      std::to_string(matrix.size()));
    for (Eigen::Index r = 0; r < matrix.rows(); ++r)
      for (Eigen::Index c = 0; c < matrix.cols(); ++c)
        matrix(r, c) = numbers[static_cast<std::size_t>(r * matrix.cols() + c)];
  };
  read("K", info.K);
  read("R", info.R);
  read("P", info.P);
  return urban_nav_core::withRawCamera(info);
}

/// Visual odometry of a stereo camera without other sensors, in the axes of its left optical frame.
class Vo {
 public:
  Vo(const py::dict& left, const py::dict& right, bool are_rectified, const std::vector<std::string>& settings)
      : calibration_(readCameraInfo(left, "left_info"), readCameraInfo(right, "right_info"), are_rectified,
                     "left_info, right_info"),
        T_base_left_(urban_nav_ros::opticalInBody()),
        filter_(readParameters(swf_vo::table(), settings), calibration_.camera(),
                T_base_left_ * calibration_.T_optical_rectified()) {}

  py::dict add(std::int64_t stamp, const std::optional<Pixels>& left, const std::optional<Pixels>& right) {
    urban_nav_core::StereoPair pair;
    pair.stamp = stamp;
    const ImageView raw_left = toView(left), raw_right = toView(right);
    const swf_vo::Frame* frame = nullptr;
    {
      const py::gil_scoped_release unlocked;
      pair.left = rectify(urban_nav_ros::Side::Left, raw_left, left_pixels_);
      pair.right = rectify(urban_nav_ros::Side::Right, raw_right, right_pixels_);
      frame = &filter_.process(pair);
    }
    return toDict(*frame);
  }

 private:
  static ImageView toView(const std::optional<Pixels>& image) {
    if (!image) return {};
    return {image->data(), static_cast<int>(image->shape(1)), static_cast<int>(image->shape(0)), image->shape(1)};
  }

  ImageView rectify(urban_nav_ros::Side side, const ImageView& image, std::vector<std::uint8_t>& pixels) const {
    if (image.empty()) return image;
    const ImageView rectified = calibration_.rectify(side, image, pixels);
    if (rectified.empty())
      throw UserError(side == urban_nav_ros::Side::Left ? "left" : "right",
                      std::to_string(image.width) + "x" + std::to_string(image.height) + " px",
                      "the size of the calibration");
    return rectified;
  }

  py::dict toDict(const swf_vo::Frame& frame) const {
    const urban_nav_core::Matrix3d R = T_base_left_.R();
    Matrix6d turn = Matrix6d::Zero();
    turn.topLeftCorner<3, 3>() = R.transpose();
    turn.bottomRightCorner<3, 3>() = R.transpose();
    Doubles features({static_cast<py::ssize_t>(frame.features.size()), py::ssize_t{3}});
    double* out = features.mutable_data();
    for (const swf_vo::Feature& feature : frame.features)
      for (int i = 0; i < 3; ++i) *out++ = feature.pixel[i];
    py::dict dict;
    dict["stamp_ns"] = frame.stamp;
    dict["accepted"] = frame.accepted;
    dict["status"] = toString(frame.status.health);
    dict["reason"] = toString(static_cast<swf_vo::Reason>(frame.status.reason));
    dict["sentence"] = toText(frame.status.sentence);
    dict["T_first_left"] = toArray((T_base_left_.inverse() * frame.T_odom_base.pose * T_base_left_).matrix());
    dict["covariance"] = toArray(Matrix6d(turn * frame.T_odom_base.covariance * turn.transpose()));
    dict["features"] = features;
    return dict;
  }

  const urban_nav_ros::StereoCalibration calibration_;
  const Pose T_base_left_;  // a rotation: the left camera is at the origin of base_link
  swf_vo::SwfVo filter_;
  std::vector<std::uint8_t> left_pixels_, right_pixels_;
};

/// A pose graph in space that is relaxed as a whole.
class Relaxation {
 public:
  explicit Relaxation(const std::vector<std::string>& settings)
      : parameters_(readParameters(pose_graph::table(), settings)) {
    if (parameters_.solver != "gauss_newton")
      throw UserError("pose_graph.solver = " + parameters_.solver, "is not available in Relaxation", "gauss_newton");
  }

  void addPose(std::int64_t id, const Doubles& T) {
    if (!poses_.emplace(id, toRigid(T)).second)
      throw UserError("add_pose", "pose " + std::to_string(id) + " was added before", "each id once");
  }

  void addEdge(std::int64_t a, std::int64_t b, const Doubles& T_a_b, const Doubles& information) {
    for (const std::int64_t id : {a, b})
      if (poses_.count(id) == 0)
        throw UserError("add_edge", "pose " + std::to_string(id) + " does not exist", "poses that add_pose() added");
    if (a == b) throw UserError("add_edge", "an edge of pose " + std::to_string(a) + " to itself", "two poses");
    const pose_graph::Rigid<3> Z = toRigid(T_a_b);
    Matrix6d turn = Matrix6d::Zero();  // from the axes of b, in which the solver measures errors, to those of a
    turn.topLeftCorner<3, 3>() = Z.R;
    turn.bottomRightCorner<3, 3>() = Z.R;
    edges_.push_back({a, b, Z, turn.transpose() * toMatrix<6>(information) * turn});
  }

  py::dict optimise() {
    pose_graph::Problem<3> problem = makeProblem();
    pose_graph::SolveOptions options;
    options.iterations = parameters_.iterations;
    bool is_stopped = false;
    options.progress = [&](int, double) {
      const py::gil_scoped_acquire lock;
      is_stopped = is_stopped || PyErr_CheckSignals() != 0;
      return !is_stopped;
    };
    pose_graph::RobustSolution<3> robust;
    robust.edges.resize(problem.edges.size());
    {
      const py::gil_scoped_release unlocked;
      if (parameters_.robust) robust = relaxSelected(problem, pose_graph::rolesByNumbers(problem), options);
      else robust.solution = solve(problem, options);
    }
    if (is_stopped) throw py::error_already_set();
    std::size_t next = 0;
    for (auto& [id, pose] : poses_) pose = robust.solution.poses[next++];
    return toDict(robust);
  }

  py::dict poses() const {
    py::dict all;
    for (const auto& [id, pose] : poses_) all[py::int_(id)] = toArray(toPose(pose).matrix());
    return all;
  }

 private:
  struct Measured {
    std::int64_t a, b;
    pose_graph::Rigid<3> Z;
    Matrix6d information;
  };

  static pose_graph::Rigid<3> toRigid(const Doubles& T) {
    const Eigen::Matrix4d matrix = toMatrix<4>(T);
    const urban_nav_core::Matrix3d R = matrix.topLeftCorner<3, 3>();
    return pose_graph::toRigid<3>(Pose(R, urban_nav_core::Vector3d(matrix.topRightCorner<3, 1>())));
  }

  pose_graph::Problem<3> makeProblem() const {
    if (edges_.empty()) throw UserError("optimise", "the graph has no edge", "at least one, by add_edge()");
    pose_graph::Problem<3> problem;
    std::map<std::int64_t, int> numbers;
    for (const auto& [id, pose] : poses_) {
      numbers[id] = static_cast<int>(problem.poses.size());
      problem.poses.push_back(pose);
    }
    for (const Measured& measured : edges_) {
      pose_graph::Edge<3> edge;
      edge.from = numbers.at(measured.a);
      edge.to = numbers.at(measured.b);
      edge.Z = measured.Z;
      edge.information = measured.information;
      problem.edges.push_back(edge);
    }
    return problem;
  }

  static py::dict toDict(const pose_graph::RobustSolution<3>& robust) {
    Doubles weights(static_cast<py::ssize_t>(robust.edges.size()));
    std::size_t rejected = 0;
    for (std::size_t e = 0; e < robust.edges.size(); ++e) {
      weights.mutable_data()[e] = robust.edges[e].weight;
      rejected += robust.edges[e].verdict == urban_nav_core::ClosureVerdict::Rejected ? 1 : 0;
    }
    py::dict dict;
    dict["cost_before"] = robust.solution.cost_before;
    dict["cost_after"] = robust.solution.cost;
    dict["iterations"] = robust.solution.iterations.size();
    dict["ending"] = toString(robust.solution.ending);
    dict["edges_rejected"] = rejected;
    dict["weights"] = weights;
    return dict;
  }

  pose_graph::Parameters parameters_;
  std::map<std::int64_t, pose_graph::Rigid<3>> poses_;
  std::vector<Measured> edges_;
};

}  // namespace

void addEstimators(py::module_& module) {
  py::class_<Vo>(module, "Vo")
      .def(py::init<const py::dict&, const py::dict&, bool, const std::vector<std::string>&>(), py::arg("left"),
           py::arg("right"), py::arg("rectified"), py::arg("settings"))
      .def("add", &Vo::add, py::arg("stamp_ns"), py::arg("left"), py::arg("right"));
  py::class_<Relaxation>(module, "Relaxation")
      .def(py::init<const std::vector<std::string>&>(), py::arg("settings"))
      .def("add_pose", &Relaxation::addPose, py::arg("id"), py::arg("T"))
      .def("add_edge", &Relaxation::addEdge, py::arg("a"), py::arg("b"), py::arg("T_a_b"), py::arg("information"))
      .def("optimise", &Relaxation::optimise)
      .def("poses", &Relaxation::poses);
}

}  // namespace urban_nav_python
