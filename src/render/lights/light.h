// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "render/pixel_samples.h"
#include "render/vec.h"
#include "render/world.h"

namespace umbrix::render {

/// Why a light sends a point nothing, known without a ray.
enum class Unreached { no, beyond_range, outside_cone, emitter_faces_away, no_power };

/// A point that light falls on.
struct Receiver {
  Vec3 point;   ///< on the surface
  Vec3 origin;  ///< where its shadow rays start, off the surface by the point's rounding error
  Vec3 normal;  ///< unit, the shading normal
};

/// Light on its way to a point.
struct Arrival {
  Unreached unreached = Unreached::no;
  Vec3 to_light{0};  ///< from the point; its end, at t = 1, is on the light, unless tmax is infinite
  float tmax = 1;    ///< where the shadow ray ends: 1, or infinity for a light without a place
  Rgb irradiance{
      0};          ///< on a surface that faces the light: for lights with an area radiance over density of directions
  Vec3 normal{0};  ///< unit, of the light where the ray ends, on the side that shines; zero for a light without area
  Vec3 error{0};   ///< bounds how far the ray's end is from the light's surface, per axis
  double density = 0;  ///< Light::density of this way
};

struct Surface;

/// A light as rendering needs it, with what is worth computing once. Adding a type is a file that defines its LightKind
/// and a line in umbrix/io/light_types.h. Const calls are thread-safe.
class Light {
 public:
  Light() = default;
  virtual ~Light() = default;
  Light(const Light&) = delete;
  Light& operator=(const Light&) = delete;

  /// One way on which light may reach the receiver. A light with an area chooses it by `u`, so that over all u the mean
  /// of irradiance times any function of the direction is that function's integral over the radiance that arrives; it
  /// may rely on the receiver's seeing its own hemisphere only. A punctual light has but one way and needs no `u`.
  virtual Arrival sample(const Receiver& receiver, const SamplePoint& u) const = 0;

  /// How densely `sample` chooses a unit direction, per steradian: of a ray that left the scene if `surface` is null,
  /// else of one that met it. 0 if no ray can meet the light, as it is no part of the scene.
  virtual double density(const Receiver& receiver, const Vec3& direction, const Surface* surface) const;

  /// About what a light with an area gives off in all: lights are chosen by it where they are many. 0: nothing at all.
  virtual double power() const { return 0; }

  /// What a ray sees that leaves the scene in a unit direction.
  virtual Rgb background(const Vec3& direction) const;

  /// Whether there is such a background.
  virtual bool surrounds() const { return false; }
};

/// What a type of light is to the table.
struct LightKind {
  std::unique_ptr<Light> (*make)(const io::Light& light, const World& world);
};

/// The light, for a world that outlives it. Throws std::bad_alloc.
std::unique_ptr<Light> make_light(const io::Light& light, const World& world);

/// A punctual light: its arrival as a function.
template <Arrival (*arrive)(const io::Light& light, const Vec3& point)>
class PunctualLight final : public Light {
 public:
  explicit PunctualLight(const io::Light& light) : light_(light) {}

  static std::unique_ptr<Light> make(const io::Light& light, const World&) {
    return std::make_unique<PunctualLight>(light);
  }

  Arrival sample(const Receiver& receiver, const SamplePoint&) const override { return arrive(light_, receiver.point); }

 private:
  io::Light light_;
};

/// A point light's arrival: inverse square, and the range window that KHR_lights_punctual recommends. Lights with a
/// place build on it.
Arrival arrive_from_position(const io::Light& light, const Vec3& point);

/// Radiance of a light with an area.
Rgb radiance_of(const io::Light& light);

}  // namespace umbrix::render
