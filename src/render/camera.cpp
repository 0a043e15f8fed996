// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include <cmath>
#include <glm/mat4x4.hpp>

namespace umbrix::render {
namespace {

Vec3 column(const io::Transform& m, std::size_t c) { return Vec3(m[0][c], m[1][c], m[2][c]); }

// GLM stores columns and multiplies column vectors; read in memory order, that is OpenEXR's row-vector matrix.
std::vector<float> to_floats(const glm::dmat4& m) {
  std::vector<float> floats;
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) floats.push_back(static_cast<float>(m[c][r]));
  }
  return floats;
}

glm::dmat4 rows(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c, const glm::dvec4& d) {
  return glm::transpose(glm::dmat4(a, b, c, d));
}

}  // namespace

Camera::Camera(const io::Camera& camera, int width, int height)
    : eye_(column(camera.to_world, 3)),
      right_(glm::normalize(column(camera.to_world, 0))),
      up_(glm::normalize(column(camera.to_world, 1))),
      forward_(-glm::normalize(column(camera.to_world, 2))),
      perspective_(camera.type == io::CameraType::perspective),
      half_height_(perspective_ ? std::tan(camera.yfov / 2) : camera.ymag),
      width_(width),
      height_(height),
      znear_(static_cast<float>(camera.znear)),
      zfar_(static_cast<float>(camera.zfar)) {
  half_width_ = half_height_ * width_ / height_;
}

Ray Camera::ray(double x, double y) const {
  const Vec3 across = right_ * ((2 * x / width_ - 1) * half_width_) + up_ * ((1 - 2 * y / height_) * half_height_);
  Ray ray;
  store(perspective_ ? eye_ : eye_ + across, ray.origin);
  store(perspective_ ? forward_ + across : forward_, ray.direction);
  ray.tmin = znear_;
  ray.tmax = zfar_;
  return ray;
}

std::vector<float> Camera::world_to_camera() const {
  return to_floats(rows({right_, -glm::dot(right_, eye_)}, {up_, -glm::dot(up_, eye_)},
                        {forward_, -glm::dot(forward_, eye_)}, {0, 0, 0, 1}));
}

std::vector<float> Camera::world_to_ndc() const {
  const glm::dvec4 right(right_, -glm::dot(right_, eye_));
  const glm::dvec4 up(up_, -glm::dot(up_, eye_));
  const glm::dvec4 depth(forward_, -glm::dot(forward_, eye_));
  const glm::dvec4 w = perspective_ ? depth : glm::dvec4(0, 0, 0, 1);
  // Pixels are width/2 (1 + right / half_width) across.
  const glm::dvec4 ndc_x = (right * (width_ / 2 / half_width_) + w * (width_ / 2)) / width_;
  const glm::dvec4 ndc_y = (up * (-height_ / 2 / half_height_) + w * (height_ / 2)) / height_;
  return to_floats(rows(ndc_x, ndc_y, depth, w));
}

}  // namespace umbrix::render
