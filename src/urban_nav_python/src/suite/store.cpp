// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "errors.hpp"
#include "suite/arrays.hpp"
#include "suite/estimators.hpp"
#include "urban_nav/stored_results.hpp"
#include "urban_nav_core/types/error.hpp"

namespace py = pybind11;

namespace urban_nav_python {
namespace {

using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

/// Content of a store as it was when it was opened.
class StoreReader {
 public:
  explicit StoreReader(const std::string& path) : store_(path, urban_nav_store::Access::Snapshot) {
    for (auto& map : urban_nav_store::readMaps(store_, store_.sessions().all())) {
      for (StoredTrajectory& each : map) {
        sessions_.push_back(std::move(each));
        maps_.push_back(maps_count_);
      }
      ++maps_count_;
    }
  }

  /// Returns (id, name, robot, map, start, complete, relaxed, poses) of every session, map after map.
  py::list sessions() const {
    py::list all;
    for (std::size_t i = 0; i < sessions_.size(); ++i) {
      const urban_nav_store::Session& session = sessions_[i].session;
      all.append(py::make_tuple(session.id, toText(session.name), toText(session.robot), maps_[i], session.start,
                                session.complete, sessions_[i].relaxed, sessions_[i].T_map_base.size()));
    }
    return all;
  }

  /// Returns (stamps, poses) of a session by its number.
  py::tuple trajectory(std::size_t number) const {
    const auto& poses = sessions_.at(number).T_map_base;
    py::array_t<std::int64_t> stamps(static_cast<py::ssize_t>(poses.size()));
    std::vector<Eigen::Matrix4d> matrices;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      stamps.mutable_data()[i] = poses[i].stamp;
      matrices.push_back(poses[i].pose.matrix());
    }
    return py::make_tuple(stamps, toStack<4>(matrices));
  }

  /// Returns the covariances of a session's poses. Throws DataError if the store holds none.
  Doubles covariances(std::size_t number) {
    const StoredTrajectory& session = sessions_.at(number);
    const urban_nav::StoredCovariances each = urban_nav::readStoredCovariances(store_, session.session.id);
    if (each.poses.empty() && !session.T_map_base.empty())
      throw urban_nav_core::DataError(
          store_.path(), "holds no covariances of the poses of session " + session.session.name,
          "a store that map has written: this one was written live, or by an earlier version");
    return toStack<6>(each.poses);
  }

  /// Returns the covariances of the steps between a session's poses.
  Doubles relativeCovariances(std::size_t number) {
    return toStack<6>(urban_nav::readStoredCovariances(store_, sessions_.at(number).session.id).steps);
  }

  std::string closures() { return urban_nav::readStoredClosures(store_); }

  /// Returns (camera, stamps) of the keyframes of a session by its number.
  py::list keyframes(std::size_t number) {
    const std::string& id = sessions_.at(number).session.id;
    py::list all;
    for (const std::string& camera : store_.keyframes().cameras(id))
      all.append(py::make_tuple(camera, store_.keyframes().stamps(id, camera)));
    return all;
  }

  /// Returns the image of a keyframe, H x W or H x W x 3 (RGB); None if it has none.
  py::object keyframeImage(const std::string& id, const std::string& camera, std::int64_t stamp) {
    const auto keyframe = store_.keyframes().get(id, camera, stamp);
    if (!keyframe || keyframe->image.empty()) return py::none();
    const std::vector<unsigned char> bytes(keyframe->image.begin(), keyframe->image.end());
    const cv::Mat image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    if (image.empty() || image.depth() != CV_8U)
      throw urban_nav_core::DataError(store_.path(), "the image of a keyframe is damaged", "");
    const int channels = image.channels();
    py::array_t<std::uint8_t> array(channels == 1 ? std::vector<py::ssize_t>{image.rows, image.cols}
                                                  : std::vector<py::ssize_t>{image.rows, image.cols, py::ssize_t{3}});
    std::uint8_t* out = array.mutable_data();
    for (int v = 0; v < image.rows; ++v)
      for (int u = 0; u < image.cols; ++u) {
        const std::uint8_t* pixel = image.ptr<std::uint8_t>(v) + static_cast<std::ptrdiff_t>(u) * channels;
        if (channels == 1) *out++ = *pixel;
        else
          for (int c = 2; c >= 0; --c) *out++ = pixel[c];
      }
    return py::object(std::move(array));
  }

 private:
  Store store_;
  std::vector<StoredTrajectory> sessions_;
  std::vector<int> maps_;  // number of the map of each session
  int maps_count_ = 0;
};

}  // namespace

void addStore(py::module_& module) {
  py::class_<StoreReader>(module, "StoreReader")
      .def(py::init<const std::string&>(), py::arg("path"))
      .def("sessions", &StoreReader::sessions)
      .def("trajectory", &StoreReader::trajectory, py::arg("number"))
      .def("covariances", &StoreReader::covariances, py::arg("number"))
      .def("relative_covariances", &StoreReader::relativeCovariances, py::arg("number"))
      .def("closures", [](StoreReader& self) { return toText(self.closures()); })
      .def("keyframes", &StoreReader::keyframes, py::arg("number"))
      .def("keyframe_image", &StoreReader::keyframeImage, py::arg("session"), py::arg("camera"), py::arg("stamp_ns"));
}

}  // namespace urban_nav_python
