// SPDX-License-Identifier: Apache-2.0
// A sphere that shines evenly outwards. Points are uniform in the cone of directions in which it is seen (Pharr, Jakob
// & Humphreys 2023, section 6.2.4).
#include <algorithm>
#include <cmath>

#include "render/lights/light.h"
#include "render/sampling/directions.h"

namespace umbrix::render {
namespace {

class SphereLight final : public Light {
 public:
  explicit SphereLight(const io::Light& light)
      : radiance_(radiance_of(light)), centre_(to_vec3(light.position)), radius_(light.radius) {}

  static std::unique_ptr<Light> make(const io::Light& light, const World&) {
    return std::make_unique<SphereLight>(light);
  }

  Arrival sample(const Receiver& receiver, const SamplePoint& u) const override {
    Arrival arrival;
    const Vec3 from_centre = receiver.origin - centre_;
    const double distance = glm::length(from_centre);
    if (!(distance > radius_)) {
      arrival.unreached = Unreached::emitter_faces_away;
      return arrival;
    }
    if (radiance_ == Rgb(0)) {
      arrival.unreached = Unreached::no_power;
      return arrival;
    }
    // The angle off the cone's axis; 1 - cosine without the cancellation that a distant sphere would suffer.
    const double sin2_most = (radius_ / distance) * (radius_ / distance);
    const double cone = sin2_most / (1 + std::sqrt(1 - sin2_most));
    const double below_one = u.x * cone;
    const double sin2 = below_one * (2 - below_one);

    // The angle at the centre between the axis and the near one of the two points in that direction.
    const double cosine = std::clamp(
        sin2 / std::sqrt(sin2_most) + (1 - below_one) * std::sqrt(std::max(1 - sin2 / sin2_most, 0.0)), -1.0, 1.0);
    const double sine = std::sqrt(1 - cosine * cosine), around = 2 * kPi * u.y;
    const Frame3 frame(from_centre / distance);
    const Vec3 normal = frame.to_world(Vec3(sine * std::cos(around), sine * std::sin(around), cosine));

    arrival.to_light = centre_ + radius_ * normal - receiver.point;
    arrival.irradiance = radiance_ * (2 * kPi * cone);
    arrival.normal = normal;
    arrival.error = (glm::abs(centre_) + radius_) * 0x1p-49;
    return arrival;
  }

  double power() const override { return luminance(radiance_) * 4 * kPi * kPi * radius_ * radius_; }

 private:
  Rgb radiance_;
  Vec3 centre_;
  double radius_;
};

}  // namespace

extern const LightKind k_sphere_light = {SphereLight::make};

}  // namespace umbrix::render
