// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/render.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace urban_nav_core::testing {
namespace {

// A pixel at the border of planes is the weighted mean of 4x4 points. In units of the blur: their spacing, the variance
// of their normal weights, and the remaining blur of each, chosen such that the variances add up to that of one pixel.
constexpr int kPoints = 4;
constexpr double kStep = 0.9, kWeightVariance = 0.7, kPointBlur = 0.64;
// Number of adjacent pixels of a row that share the filter of the central one.
constexpr int kRun = static_cast<int>(Texture::kRun);
constexpr double kEdgeOn = 1e-9;  // determinant below which a plane is seen from its edge

}  // namespace

Renderer::Renderer(const RenderCamera& camera) : camera_(camera) {
  const std::size_t size = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  for (int i = 0; i < kPoints; ++i)
    for (int k = 0; k < kPoints; ++k) {
      const double du = k - 0.5 * (kPoints - 1), dv = i - 0.5 * (kPoints - 1);
      point_weights_.push_back(std::exp(-0.5 * kStep * kStep * (du * du + dv * dv) / kWeightVariance));
    }
  owner_.resize(size);
  inverse_z_.resize(size);
  image_.resize(size);
}

void Renderer::place(const Scene& scene, const Pose& T_world_camera) {
  const Pose T_camera_world = T_world_camera.inverse();
  const Eigen::Matrix3d R = T_camera_world.R();
  Eigen::Matrix3d ray;  // (u, v, 1) -> direction with z = 1
  ray << 1.0 / camera_.fx, 0.0, -camera_.cx / camera_.fx, 0.0, 1.0 / camera_.fy, -camera_.cy / camera_.fy, 0.0, 0.0,
      1.0;
  planes_.clear();
  background_ = scene.background;
  for (const Rectangle& rectangle : scene.rectangles) {
    const Vector3d corner = T_camera_world * rectangle.corner;
    Eigen::Matrix3d M;
    M << R * rectangle.a, R * rectangle.b, corner;
    if (M.determinant() > -kEdgeOn) continue;  // a x b points away, or the plane is seen edge-on
    const double farthest =
        corner.z() + std::max(0.0, rectangle.size_a * M(2, 0)) + std::max(0.0, rectangle.size_b * M(2, 1));
    if (farthest <= 0.0) continue;
    Plane plane;
    plane.N = M.inverse() * ray;
    plane.N.row(0) += rectangle.texture_x * plane.N.row(2);
    plane.N.row(1) += rectangle.texture_y * plane.N.row(2);
    plane.a0 = rectangle.texture_x;
    plane.a1 = rectangle.texture_x + rectangle.size_a;
    plane.b0 = rectangle.texture_y;
    plane.b1 = rectangle.texture_y + rectangle.size_b;
    plane.texture = rectangle.texture.get();
    plane.shade = rectangle.shade;
    planes_.push_back(plane);
  }
}

void Renderer::claim(int index) {
  const Plane& plane = planes_[static_cast<std::size_t>(index)];
  const Eigen::RowVector3d a = plane.N.row(0), b = plane.N.row(1), w = plane.N.row(2);
  // Inside the rectangle and in front of the camera: five conditions linear in (u, v).
  constexpr double kFarthest = 1e-5;  // 1/m
  const std::array<Eigen::RowVector3d, 5> conditions{a - plane.a0 * w, plane.a1 * w - a, b - plane.b0 * w,
                                                     plane.b1 * w - b, w - kFarthest * Eigen::RowVector3d::UnitZ()};
  for (int v = 0; v < camera_.height; ++v) {
    double first = 0.0, last = camera_.width - 1.0;
    for (const Eigen::RowVector3d& c : conditions) {
      const double slope = c(0), rest = c(1) * v + c(2);
      if (slope > 0.0) {
        first = std::max(first, -rest / slope);
      } else if (slope < 0.0) {
        last = std::min(last, -rest / slope);
      } else if (rest < 0.0) {
        last = -1.0;
      }
    }
    if (!(first <= last)) continue;
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width);
    for (int u = static_cast<int>(std::ceil(first)); u <= static_cast<int>(std::floor(last)); ++u) {
      const std::size_t i = row + static_cast<std::size_t>(u);
      const auto inverse_z = static_cast<float>(w(0) * u + w(1) * v + w(2));
      if (inverse_z > inverse_z_[i]) {
        inverse_z_[i] = inverse_z;
        owner_[i] = index;
      }
    }
  }
}

Renderer::Place Renderer::placeAt(const Plane& plane, double u, double v) {
  const Eigen::Matrix3d& N = plane.N;
  const double scale = 1.0 / (N(2, 0) * u + N(2, 1) * v + N(2, 2));
  return {(N(0, 0) * u + N(0, 1) * v + N(0, 2)) * scale, (N(1, 0) * u + N(1, 1) * v + N(1, 2)) * scale, scale};
}

Texture::Filter Renderer::filterAt(const Plane& plane, double u, double v, double blur) {
  const Eigen::Matrix3d& N = plane.N;
  const Place at = placeAt(plane, u, v);
  const double k = at.scale * blur;
  const double a_u = (N(0, 0) - at.a * N(2, 0)) * k, a_v = (N(0, 1) - at.a * N(2, 1)) * k;
  const double b_u = (N(1, 0) - at.b * N(2, 0)) * k, b_v = (N(1, 1) - at.b * N(2, 1)) * k;
  return plane.texture->filter({a_u * a_u + a_v * a_v, a_u * b_u + a_v * b_v, b_u * b_u + b_v * b_v});
}

int Renderer::ownerAt(int u, int v) const {
  return owner_[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width) + static_cast<std::size_t>(u)];
}

bool Renderer::isBorder(int u, int v) const {
  const int mine = ownerAt(u, v);
  for (int y = std::max(0, v - 1); y <= std::min(camera_.height - 1, v + 1); ++y) {
    for (int x = std::max(0, u - 1); x <= std::min(camera_.width - 1, u + 1); ++x) {
      if (ownerAt(x, y) != mine) return true;
    }
  }
  return false;
}

std::vector<const Renderer::Plane*> Renderer::planesAbout(int u, int v) const {
  std::vector<const Plane*> planes;
  for (int y = std::max(0, v - 1); y <= std::min(camera_.height - 1, v + 1); ++y) {
    for (int x = std::max(0, u - 1); x <= std::min(camera_.width - 1, u + 1); ++x) {
      if (ownerAt(x, y) < 0) continue;
      const Plane* plane = &planes_[static_cast<std::size_t>(ownerAt(x, y))];
      if (std::find(planes.begin(), planes.end(), plane) == planes.end()) planes.push_back(plane);
    }
  }
  return planes;
}

const Renderer::Plane* Renderer::nearest(const std::vector<const Plane*>& planes, const Eigen::Vector3d& pixel) {
  const Plane* nearest = nullptr;
  double nearest_w = 0.0;
  for (const Plane* plane : planes) {
    const Eigen::Vector3d q = plane->N * pixel;
    constexpr double kSeam = 1e-6;  // m: no gaps where two rectangles share an edge
    const bool inside = q(0) >= (plane->a0 - kSeam) * q(2) && q(0) <= (plane->a1 + kSeam) * q(2) &&
                        q(1) >= (plane->b0 - kSeam) * q(2) && q(1) <= (plane->b1 + kSeam) * q(2);
    if (inside && q(2) > nearest_w) {
      nearest = plane;
      nearest_w = q(2);
    }
  }
  return nearest;
}

double Renderer::blend(int u, int v) const {
  const std::vector<const Plane*> planes = planesAbout(u, v);
  const double step = kStep * camera_.blur, point_blur = kPointBlur * camera_.blur;
  const Plane* filtered = nullptr;
  Texture::Filter filter;
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    for (int k = 0; k < kPoints; ++k) {
      const double du = (k - 0.5 * (kPoints - 1)) * step, dv = (i - 0.5 * (kPoints - 1)) * step;
      const double weight = point_weights_[static_cast<std::size_t>(i * kPoints + k)];
      const Eigen::Vector3d p(u + du, v + dv, 1.0);
      const Plane* plane = nearest(planes, p);
      double grey = background_;
      if (plane != nullptr) {
        if (plane != filtered) filter = filterAt(*plane, p(0), p(1), point_blur);
        filtered = plane;
        const Place at = placeAt(*plane, p(0), p(1));
        grey = plane->shade * plane->texture->value(at.a, at.b, filter);
      }
      sum += weight * grey;
      weights += weight;
    }
  }
  return sum / weights;
}

const std::vector<float>& Renderer::draw(const Scene& scene, const Pose& T_world_camera) {
  place(scene, T_world_camera);
  std::fill(owner_.begin(), owner_.end(), -1);
  std::fill(inverse_z_.begin(), inverse_z_.end(), 0.0F);
  for (int i = 0; i < static_cast<int>(planes_.size()); ++i) claim(i);
  for (int v = 0; v < camera_.height; ++v) drawRow(v);
  return image_;
}

bool Renderer::drawRun(int u0, int v) {
  const int owner = ownerAt(u0, v);
  if (owner < 0 || u0 + kRun > camera_.width) return false;
  for (int y = std::max(0, v - 1); y <= std::min(camera_.height - 1, v + 1); ++y) {
    for (int x = std::max(0, u0 - 1); x <= std::min(camera_.width - 1, u0 + kRun); ++x) {
      if (ownerAt(x, y) != owner) return false;
    }
  }
  const Plane& plane = planes_[static_cast<std::size_t>(owner)];
  Texture::Run a, b, grey;
  for (int i = 0; i < kRun; ++i) {
    const Place at = placeAt(plane, u0 + i, v);
    a[static_cast<std::size_t>(i)] = at.a;
    b[static_cast<std::size_t>(i)] = at.b;
  }
  plane.texture->values(a, b, filterAt(plane, u0 + 0.5 * (kRun - 1), v, camera_.blur), grey);
  float* out = pixel(u0, v);
  for (const double value : grey) *out++ = static_cast<float>(plane.shade * value);
  return true;
}

void Renderer::drawRow(int v) {
  for (int u0 = 0; u0 < camera_.width; u0 += kRun) {
    if (drawRun(u0, v)) continue;
    for (int u = u0; u < std::min(u0 + kRun, camera_.width); ++u) {
      const int owner = ownerAt(u, v);
      double grey = background_;
      if (isBorder(u, v)) {
        grey = blend(u, v);
      } else if (owner >= 0) {
        const Plane& plane = planes_[static_cast<std::size_t>(owner)];
        const Place at = placeAt(plane, u, v);
        grey = plane.shade * plane.texture->value(at.a, at.b, filterAt(plane, u, v, camera_.blur));
      }
      *pixel(u, v) = static_cast<float>(grey);
    }
  }
}

float* Renderer::pixel(int u, int v) {
  return image_.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width) +
         static_cast<std::size_t>(u);
}

}  // namespace urban_nav_core::testing
