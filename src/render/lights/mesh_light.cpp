// SPDX-License-Identifier: Apache-2.0
// An emissive mesh: a triangle is chosen by its area and brightness, then a point of it, which shines as its texture
// says. Triangles shine on the side of their normals, on both if the material is double-sided: as they are seen by the
// camera (Surface::emits).
#include <algorithm>
#include <cmath>
#include <iterator>

#include "render/lights/light.h"
#include "render/materials/material_at.h"
#include "render/sampling/discrete_distribution.h"
#include "render/sampling/spherical_triangle.h"
#include "render/surface.h"

namespace umbrix::render {
namespace {

/// Outside of these the point is chosen by area: small ones look alike either way and their solid angle has few digits
/// (seen edge-on it has none); of one that covers nearly a hemisphere the sides cross at angles that are not known
/// well.
constexpr double kLeastSolidAngle = 1e-4, kMostSolidAngle = 6.22;

class MeshLight final : public Light {
 public:
  MeshLight(const io::Light& light, const World& world) : file_(*world.file), radiance_(radiance_of(light)) {
    // Meshes are in the order of instances. One that alpha hides is not in the world, and shines on nothing.
    const auto found =
        std::lower_bound(world.meshes.begin(), world.meshes.end(), light.instance,
                         [](const WorldMesh& mesh, std::uint32_t instance) { return mesh.instance < instance; });
    if (found == world.meshes.end() || found->instance != light.instance) return;
    mesh_ = &*found;
    const io::Material& material = file_.materials[mesh_->mesh->material];
    double_sided_ = material.double_sided;
    textured_ = material.emissive_texture.texture >= 0 || material.alpha_mode != io::AlphaMode::opaque;
    std::vector<double> weights;
    weights.reserve(mesh_->mesh->triangles.size());
    for (std::size_t i = 0; i < mesh_->mesh->triangles.size(); ++i) {
      weights.push_back(Shape(*mesh_, i).area() * (textured_ ? brightness(i) : 1));
    }
    by_power_ = DiscreteDistribution(weights);
  }

  static std::unique_ptr<Light> make(const io::Light& light, const World& world) {
    return std::make_unique<MeshLight>(light, world);
  }

  Arrival sample(const Receiver& receiver, const SamplePoint& u) const override {
    Arrival arrival;
    if (radiance_ == Rgb(0) || !(by_power_.total() > 0)) {
      arrival.unreached = Unreached::no_power;
      return arrival;
    }
    const Choice choice = by_power_.choose(u.x);
    const Shape triangle(*mesh_, choice.index);
    const double height = glm::dot(receiver.origin - triangle.corners[0], triangle.normal);
    if (!(height > 0) && !(double_sided_ && height < 0)) {
      arrival.unreached = Unreached::emitter_faces_away;
      return arrival;
    }
    double solid_angle = 0;  // of the triangle, or as if all of it were seen as the point is
    const SamplePoint b = point_of(triangle, receiver, {choice.rest, u.y}, solid_angle);
    arrival.to_light = triangle.at(b.x, b.y) - receiver.point;
    arrival.irradiance = radiance_at(choice.index, b) * (solid_angle / choice.probability);
    arrival.normal = height > 0 ? triangle.normal : -triangle.normal;
    arrival.error = triangle.error();
    arrival.density = choice.probability / solid_angle;
    return arrival;
  }

  double density(const Receiver& receiver, const Vec3&, const Surface* surface) const override {
    if (!surface || !(by_power_.total() > 0)) return 0;
    const std::size_t number = surface->primitive.triangle;
    const double solid_angle = seen_solid_angle(Shape(*mesh_, number), receiver, surface->point);
    return solid_angle > 0 ? by_power_.probability(number) / solid_angle : 0;
  }

  double power() const override { return luminance(radiance_) * kPi * by_power_.total() * (double_sided_ ? 2 : 1); }

 private:
  /// A triangle in world space.
  struct Shape {
    Shape(const WorldMesh& mesh, std::size_t number) {
      const std::array<std::uint32_t, 3>& vertices = mesh.mesh->triangles[number];
      for (std::size_t k = 0; k < 3; ++k) corners[k] = to_vec3(mesh.position(vertices[k]));
      const Vec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
      twice_area = glm::length(cross);
      normal = (mesh.mirrored ? -cross : cross) / twice_area;
    }

    double area() const { return 0.5 * twice_area; }

    /// A point of the triangle is three products and two sums, of numbers up to the corners'.
    Vec3 error() const {
      return glm::max(glm::max(glm::abs(corners[0]), glm::abs(corners[1])), glm::abs(corners[2])) * 0x1p-49;
    }

    Vec3 at(double b1, double b2) const { return (1 - b1 - b2) * corners[0] + b1 * corners[1] + b2 * corners[2]; }

    Vec3 corners[3];
    Vec3 normal;
    double twice_area;
  };

  /// The barycentric coordinates of a point.
  static SamplePoint point_of(const Shape& triangle, const Receiver& receiver, const SamplePoint& u,
                              double& solid_angle) {
    const SphericalTriangle seen(triangle.corners, receiver.origin);
    if (is_well_known(seen)) {
      solid_angle = seen.solid_angle();
      return seen.point(u);
    }
    // Uniform in area (Turk 1990).
    const double root = std::sqrt(u.x);
    const SamplePoint b = {root * (1 - u.y), root * u.y};
    solid_angle = as_seen_at(triangle, receiver, triangle.at(b.x, b.y));
    return b;
  }

  static bool is_well_known(const SphericalTriangle& seen) {
    return seen.solid_angle() > kLeastSolidAngle && seen.solid_angle() < kMostSolidAngle;
  }

  /// A triangle's solid angle if all of it were seen as one of its points is.
  static double as_seen_at(const Shape& triangle, const Receiver& receiver, const Vec3& target) {
    const Vec3 way = target - receiver.origin;
    const double distance2 = glm::dot(way, way);
    return triangle.area() * std::abs(glm::dot(way, triangle.normal)) / (distance2 * std::sqrt(distance2));
  }

  /// What point_of says of a point that it makes.
  static double seen_solid_angle(const Shape& triangle, const Receiver& receiver, const Vec3& target) {
    const SphericalTriangle seen(triangle.corners, receiver.origin);
    return is_well_known(seen) ? seen.solid_angle() : as_seen_at(triangle, receiver, target);
  }

  /// About how bright a triangle is on the whole, as a share of the factor. Never 0: what no corner shows may shine.
  double brightness(std::size_t triangle) const {
    constexpr double kLeast = 0.1, kThird = 1.0 / 3;
    constexpr SamplePoint kPoints[] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0, 0.5}, {0.5, 0.5}, {kThird, kThird}};
    double sum = 0;
    for (const SamplePoint& b : kPoints) sum += luminance(radiance_at(triangle, b));
    return kLeast + (1 - kLeast) * sum / (std::size(kPoints) * luminance(radiance_));
  }

  Rgb radiance_at(std::size_t triangle, const SamplePoint& b) const {
    if (!textured_) return radiance_;
    return emission_at({file_, *mesh_->mesh, static_cast<std::uint32_t>(triangle), {1 - b.x - b.y, b.x, b.y}});
  }

  const io::SceneFile& file_;
  Rgb radiance_;  ///< of all points, or the factor of the texture
  bool textured_ = false;
  const WorldMesh* mesh_ = nullptr;
  bool double_sided_ = false;
  DiscreteDistribution by_power_;
};

}  // namespace

extern const LightKind k_mesh_light = {MeshLight::make};

}  // namespace umbrix::render
