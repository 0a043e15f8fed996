// SPDX-License-Identifier: Apache-2.0
// A rectangle that shines evenly on the side of its direction.
#include <cmath>

#include "render/lights/light.h"
#include "render/sampling/spherical_rectangle.h"

namespace umbrix::render {
namespace {

/// Below, the point is chosen by area instead: both choose alike there, and the solid angle loses its digits.
constexpr double kLeastSolidAngle = 1e-4;

class RectangleLight final : public Light {
 public:
  explicit RectangleLight(const io::Light& light) : radiance_(radiance_of(light)), normal_(to_vec3(light.direction)) {
    rectangle_.centre = to_vec3(light.position);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const Vec3 half_edge = to_vec3(light.half_edges[axis]);
      rectangle_.half_size[axis] = glm::length(half_edge);
      rectangle_.axes[axis] = half_edge / rectangle_.half_size[axis];
    }
    // The sums of a point's coordinates round less often than a dozen times.
    error_ = (glm::abs(rectangle_.centre) + rectangle_.half_size[0] + rectangle_.half_size[1]) * 0x1p-49;
  }

  static std::unique_ptr<Light> make(const io::Light& light, const World&) {
    return std::make_unique<RectangleLight>(light);
  }

  Arrival sample(const Receiver& receiver, const SamplePoint& u) const override {
    Arrival arrival;
    const double height = glm::dot(receiver.origin - rectangle_.centre, normal_);
    if (!(height > 0)) {
      arrival.unreached = Unreached::emitter_faces_away;
      return arrival;
    }
    if (radiance_ == Rgb(0)) {
      arrival.unreached = Unreached::no_power;
      return arrival;
    }
    const SphericalRectangle seen(rectangle_, receiver.origin);
    const bool by_area = !(seen.solid_angle() > kLeastSolidAngle);
    const SamplePoint place =
        by_area ? SamplePoint{(2 * u.x - 1) * rectangle_.half_size[0], (2 * u.y - 1) * rectangle_.half_size[1]}
                : seen.point(u);
    const Vec3 target = rectangle_.centre + place.x * rectangle_.axes[0] + place.y * rectangle_.axes[1];
    const Vec3 way = target - receiver.origin;
    const double distance2 = glm::dot(way, way);
    const double solid_angle = by_area ? area() * height / (distance2 * std::sqrt(distance2)) : seen.solid_angle();
    arrival.to_light = target - receiver.point;
    arrival.irradiance = radiance_ * solid_angle;
    arrival.normal = normal_;
    arrival.error = error_;
    return arrival;
  }

  double power() const override { return luminance(radiance_) * kPi * area(); }

 private:
  double area() const { return 4 * rectangle_.half_size[0] * rectangle_.half_size[1]; }

  Rgb radiance_;
  Vec3 normal_, error_;
  Rectangle rectangle_;
};

}  // namespace

extern const LightKind k_rectangle_light = {RectangleLight::make};

}  // namespace umbrix::render
