// SPDX-License-Identifier: Apache-2.0
// Light from all around. One that is the same everywhere is chosen by the cosine at the receiver; of a map, a pixel is
// chosen by what it contributes (Pharr, Jakob & Humphreys 2023, section 12.5.2), with two differences: within a pixel
// directions are uniform in solid angle, so that the poles are no exception, and since radiance is interpolated between
// pixels, a pixel's weight includes its neighbours' share of it, so that none that shines is left out.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "render/lights/light.h"
#include "render/sampling/directions.h"
#include "render/sampling/discrete_distribution.h"

namespace umbrix::render {
namespace {

/// A map as a function of direction, and directions chosen by it.
class SkyMap {
 public:
  SkyMap(std::shared_ptr<const io::EnvironmentMap> map, double rotation)
      : map_(std::move(map)), cos_(std::cos(rotation)), sin_(std::sin(rotation)) {
    std::vector<double> row_weights;
    std::vector<double> weights(map_->width);
    for (std::uint32_t y = 0; y < map_->height; ++y) {
      for (std::uint32_t x = 0; x < map_->width; ++x) weights[x] = luminance(mean_within(x, y)) * solid_angle(y);
      columns_.emplace_back(weights);
      row_weights.push_back(columns_.back().total());
    }
    rows_ = DiscreteDistribution(row_weights);
  }

  /// The integral of luminance over all directions.
  double total() const { return rows_.total(); }

  /// A unit direction; `density` is per steradian. If the total is not 0.
  Vec3 choose(const SamplePoint& u, double& density) const {
    const Choice row = rows_.choose(u.y);
    const Choice column = columns_[row.index].choose(u.x);
    const auto y = static_cast<std::uint32_t>(row.index);
    density = row.probability * column.probability / solid_angle(y);
    const double height = cos_of_row(y) + row.rest * (cos_of_row(y + 1) - cos_of_row(y));
    const double longitude = (0.5 - (static_cast<double>(column.index) + column.rest) / map_->width) * 2 * kPi;
    const double radius = std::sqrt(std::max(1 - height * height, 0.0));
    return turned(Vec3(radius * std::sin(longitude), height, radius * std::cos(longitude)), sin_);
  }

  /// Of `choose`, at a unit direction.
  double density(const Vec3& direction) const {
    const Place at = place(direction);
    const auto column = std::min(static_cast<std::uint32_t>(at.x), map_->width - 1);
    const auto row = std::min(static_cast<std::uint32_t>(at.y), map_->height - 1);
    return rows_.probability(row) > 0 ? rows_.probability(row) * columns_[row].probability(column) / solid_angle(row)
                                      : 0;
  }

  /// Bilinear between the pixels' centres.
  Rgb radiance(const Vec3& direction) const {
    const Place at = place(direction);
    const double x = at.x - 0.5, y = at.y - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const auto column = static_cast<std::int64_t>(left), row = static_cast<std::int64_t>(top);
    const Rgb above = glm::mix(pixel(column, row), pixel(column + 1, row), x - left);
    const Rgb below = glm::mix(pixel(column, row + 1), pixel(column + 1, row + 1), x - left);
    return glm::mix(above, below, y - top);
  }

 private:
  /// In pixels from the map's upper left corner.
  struct Place {
    double x, y;
  };

  Place place(const Vec3& direction) const {
    const Vec3 local = turned(direction, -sin_);
    const double from_top = std::acos(std::clamp(local.y, -1.0, 1.0)) / kPi;
    const double from_left = 0.5 - std::atan2(local.x, local.z) / (2 * kPi);
    return {from_left * map_->width, from_top * map_->height};
  }

  /// About +y, by the angle whose sine this is.
  Vec3 turned(const Vec3& v, double sine) const { return Vec3(cos_ * v.x + sine * v.z, v.y, cos_ * v.z - sine * v.x); }

  /// Goes on at the other end of a row; beyond the first and the last row there is what they hold.
  Rgb pixel(std::int64_t x, std::int64_t y) const {
    const auto width = std::int64_t{map_->width}, height = std::int64_t{map_->height};
    const std::int64_t column = (x + width) % width, row = std::clamp(y, std::int64_t{0}, height - 1);
    return to_vec3(map_->pixels[static_cast<std::size_t>(row * width + column)]);
  }

  /// Of the interpolated radiance within a pixel, by angles: an eighth of the neighbour's on each side, in both axes.
  Rgb mean_within(std::uint32_t x, std::uint32_t y) const {
    constexpr double kShare[3] = {0.125, 0.75, 0.125};
    Rgb sum(0);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        sum += kShare[dx + 1] * kShare[dy + 1] * pixel(std::int64_t{x} + dx, std::int64_t{y} + dy);
      }
    }
    return sum;
  }

  /// Of a row's upper edge.
  double cos_of_row(std::uint32_t y) const { return std::cos(kPi * y / map_->height); }

  /// Of each of a row's pixels.
  double solid_angle(std::uint32_t y) const { return 2 * kPi / map_->width * (cos_of_row(y) - cos_of_row(y + 1)); }

  std::shared_ptr<const io::EnvironmentMap> map_;
  double cos_, sin_;  ///< of the rotation
  DiscreteDistribution rows_;
  std::vector<DiscreteDistribution> columns_;  ///< of each row
};

/// pi times the squared radius of the scene: what it catches of light from one direction.
double cross_section(const World& world) {
  float lower[3], upper[3];
  if (!world.scene.bounds(lower, upper)) return 0;
  const Vec3 half = 0.5 * (load(upper) - load(lower));
  return kPi * glm::dot(half, half);
}

Arrival arrive_from_infinity(const Vec3& direction, const Rgb& irradiance, double density) {
  Arrival arrival;
  arrival.to_light = direction;
  arrival.tmax = std::numeric_limits<float>::infinity();
  arrival.irradiance = irradiance;
  arrival.density = density;
  if (irradiance == Rgb(0)) arrival.unreached = Unreached::no_power;
  return arrival;
}

class ConstantEnvironment final : public Light {
 public:
  ConstantEnvironment(const Rgb& radiance, const World& world)
      : radiance_(radiance), power_(luminance(radiance) * 4 * kPi * cross_section(world)) {}

  Arrival sample(const Receiver& receiver, const SamplePoint& u) const override {
    const Vec3 local = cosine_hemisphere(u);
    const Rgb irradiance = local.z > 0 ? radiance_ * (kPi / local.z) : Rgb(0);
    return arrive_from_infinity(Frame3(receiver.normal).to_world(local), irradiance, local.z / kPi);
  }

  double density(const Receiver& receiver, const Vec3& direction, const Surface* surface) const override {
    return surface ? 0 : std::max(glm::dot(receiver.normal, direction), 0.0) / kPi;
  }

  double power() const override { return power_; }
  bool surrounds() const override { return true; }
  Rgb background(const Vec3&) const override { return radiance_; }

 private:
  Rgb radiance_;
  double power_;
};

class MappedEnvironment final : public Light {
 public:
  MappedEnvironment(const io::Light& light, const World& world)
      : scale_(radiance_of(light)),
        sky_(light.environment, light.rotation),
        power_(luminance(scale_) * sky_.total() * cross_section(world)) {}

  Arrival sample(const Receiver&, const SamplePoint& u) const override {
    if (!(sky_.total() > 0)) return arrive_from_infinity(Vec3(0, 1, 0), Rgb(0), 0);
    double density = 0;
    const Vec3 direction = sky_.choose(u, density);
    return arrive_from_infinity(direction, background(direction) / density, density);
  }

  double density(const Receiver&, const Vec3& direction, const Surface* surface) const override {
    return surface || !(sky_.total() > 0) ? 0 : sky_.density(direction);
  }

  double power() const override { return power_; }
  bool surrounds() const override { return true; }
  Rgb background(const Vec3& direction) const override { return scale_ * sky_.radiance(direction); }

 private:
  Rgb scale_;
  SkyMap sky_;
  double power_;
};

std::unique_ptr<Light> make_environment(const io::Light& light, const World& world) {
  if (light.environment) return std::make_unique<MappedEnvironment>(light, world);
  return std::make_unique<ConstantEnvironment>(radiance_of(light), world);
}

}  // namespace

extern const LightKind k_environment_light = {make_environment};

}  // namespace umbrix::render
