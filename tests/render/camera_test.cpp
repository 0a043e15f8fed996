// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace umbrix::render {
namespace {

/// Looks along +x from (1, 2, 3), +z up.
io::Camera turned_camera() {
  io::Camera camera;
  camera.yfov = 2 * std::atan(0.5);
  camera.to_world = {{{0, 0, -1, 1}, {-1, 0, 0, 2}, {0, 1, 0, 3}}};
  return camera;
}

void expect_near(const float actual[3], double x, double y, double z) {
  EXPECT_NEAR(actual[0], x, 1e-6);
  EXPECT_NEAR(actual[1], y, 1e-6);
  EXPECT_NEAR(actual[2], z, 1e-6);
}

TEST(Camera, CentreLooksForwardAndCornersSpanTheField) {
  const Camera camera(turned_camera(), 200, 100);
  const Ray centre = camera.ray(100, 50);
  expect_near(centre.origin, 1, 2, 3);
  expect_near(centre.direction, 1, 0, 0);
  // The upper left corner: half the height up, and as the image is twice as wide, one to the left (+y).
  expect_near(camera.ray(0, 0).direction, 1, 1, 0.5);
  expect_near(camera.ray(200, 100).direction, 1, -1, -0.5);
}

TEST(Camera, PixelsAreSquareInAnyImage) {
  for (const int width : {50, 100, 300}) {
    const Camera camera(turned_camera(), width, 100);
    const Ray a = camera.ray(10, 10), right = camera.ray(11, 10), down = camera.ray(10, 11);
    EXPECT_NEAR(a.direction[1] - right.direction[1], a.direction[2] - down.direction[2], 1e-6) << width;
  }
}

TEST(Camera, DepthAlongTheAxisIsTheRaysParameter) {
  io::Camera perspective = turned_camera();
  perspective.znear = 0.25;
  io::Camera orthographic = perspective;
  orthographic.type = io::CameraType::orthographic;
  orthographic.zfar = 7;
  for (const io::Camera& described : {perspective, orthographic}) {
    const Camera camera(described, 64, 64);
    for (const double x : {0.0, 13.0, 64.0}) {
      const Ray ray = camera.ray(x, 20);
      EXPECT_NEAR(ray.origin[0] + 5 * ray.direction[0], 6, 1e-6);
      EXPECT_EQ(ray.tmin, 0.25f);
    }
  }
  EXPECT_EQ(Camera(perspective, 4, 4).ray(1, 1).tmax, std::numeric_limits<float>::infinity());
  EXPECT_EQ(Camera(orthographic, 4, 4).ray(1, 1).tmax, 7);
}

TEST(Camera, OrthographicRaysAreParallelAndSpanTheMagnification) {
  io::Camera described = turned_camera();
  described.type = io::CameraType::orthographic;
  described.ymag = 2;
  const Camera camera(described, 300, 100);
  expect_near(camera.ray(0, 0).origin, 1, 2 + 6, 3 + 2);
  expect_near(camera.ray(0, 0).direction, 1, 0, 0);
  expect_near(camera.ray(300, 100).origin, 1, 2 - 6, 3 - 2);
}

/// A row vector times an OpenEXR matrix, divided by w.
std::array<double, 3> transform(const std::array<double, 3>& p, const std::vector<float>& m) {
  double out[4];
  for (std::size_t c = 0; c < 4; ++c) {
    out[c] = p[0] * m[c] + p[1] * m[4 + c] + p[2] * m[8 + c] + m[12 + c];
  }
  return {out[0] / out[3], out[1] / out[3], out[2] / out[3]};
}

TEST(Camera, MatricesLeadBackToThePixel) {
  io::Camera orthographic = turned_camera();
  orthographic.type = io::CameraType::orthographic;
  for (const io::Camera& described : {turned_camera(), orthographic}) {
    const Camera camera(described, 320, 200);
    const Ray ray = camera.ray(70, 30);
    const std::array<double, 3> p = {ray.origin[0] + 4.0 * ray.direction[0], ray.origin[1] + 4.0 * ray.direction[1],
                                     ray.origin[2] + 4.0 * ray.direction[2]};
    const auto ndc = transform(p, camera.world_to_ndc());
    EXPECT_NEAR(ndc[0] * 320, 70, 1e-3);
    EXPECT_NEAR(ndc[1] * 200, 30, 1e-3);
    EXPECT_NEAR(transform(p, camera.world_to_camera())[2], 4, 1e-5);
  }
}

}  // namespace
}  // namespace umbrix::render
