// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "umbrix/export.h"
#include "umbrix/io/light_types.h"
#include "umbrix/io/texture.h"
#include "umbrix/status.h"

/// glTF 2.0 in: plain data, checked and in one form, whatever the file's encoding.
namespace umbrix::io {

using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;
using Double3 = std::array<double, 3>;

/// An affine transform, row-major 3x4: point' = m[row][0..2] . point + m[row][3].
using Transform = std::array<std::array<double, 4>, 3>;
inline constexpr Transform kIdentity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

enum class AlphaMode { opaque, mask, blend };

/// glTF's metallic-roughness material; colours are linear Rec.709. Textures multiply the factors beside them.
struct Material {
  std::string name;
  Float3 base_color{1, 1, 1};
  float alpha = 1;
  float metallic = 1;
  float roughness = 1;
  Float3 emission{0, 0, 0};
  float ior = 1.5f;                ///< KHR_materials_ior; 0: what is not metal reflects as if it were without bound
  float specular = 1;              ///< KHR_materials_specular
  Float3 specular_color{1, 1, 1};  ///< KHR_materials_specular; may be above 1
  bool unlit = false;              ///< KHR_materials_unlit: looks like base_color in any light, and gives none
  bool double_sided = false;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;  ///< for AlphaMode::mask
  float normal_scale = 1;     ///< of the normal texture's x and y

  TextureUse base_color_texture;          ///< sRGB, and alpha
  TextureUse metallic_roughness_texture;  ///< roughness in green, metallic in blue
  TextureUse normal_texture;
  TextureUse emissive_texture;        ///< sRGB
  TextureUse specular_texture;        ///< in alpha
  TextureUse specular_color_texture;  ///< sRGB
};

/// The textures of a material, for what is the same for all.
inline constexpr TextureUse Material::*kMaterialTextures[] = {
    &Material::base_color_texture, &Material::metallic_roughness_texture, &Material::normal_texture,
    &Material::emissive_texture,   &Material::specular_texture,           &Material::specular_color_texture};

/// One glTF primitive as a triangle list. Strips and fans are expanded, accessors decoded.
struct Mesh {
  std::string name;
  std::vector<Float3> positions;
  std::vector<Float3> normals;                                     ///< empty, or one a position; so are the next three
  std::array<std::vector<std::array<float, 2>>, 2> texcoord_sets;  ///< the second if the material asks for it
  std::vector<Float4> colors;                                      ///< linear, with alpha
  std::vector<Float4> tangents;                                    ///< x, y, z and the bitangent's sign
  std::vector<std::array<std::uint32_t, 3>> triangles;             ///< indices are in range
  std::uint32_t material = 0;                                      ///< always valid; a default material exists
};

/// A mesh placed in the world.
struct Instance {
  std::string name;
  std::uint32_t mesh = 0;
  Transform to_world = kIdentity;
};

/// Radiance from all around, infinitely far away: rows from the top (+y) to the bottom, in equal steps of the angle
/// from +y. As OpenEXR's latitude-longitude maps, it is seen from within: the middle column looks along +z, the left
/// half is on the side of +x. Linear Rec.709, finite, not negative.
struct EnvironmentMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Float3> pixels;  ///< width * height
};

/// A light in world space. What it emits is color * intensity: candela for point and spot, lux for directional
/// (KHR_lights_punctual); for those with an area radiance, in candela per square metre, which for a map scales it.
/// Lights are no geometry: they hide nothing, and only an environment is seen.
struct Light {
  std::string name;
  LightType type = LightType::point;
  Float3 color{1, 1, 1};
  float intensity = 1;
  float range = std::numeric_limits<float>::infinity();  ///< no light beyond; infinite if the file has none
  Double3 position{0, 0, 0};                             ///< the centre
  Double3 direction{0, 0, -1};  ///< the way the light shines; unit length; of rectangles, the side that shines
  float inner_cone_angle = 0;   ///< radians, for spots
  float outer_cone_angle = 0.7853982f;
  std::array<Double3, 2> half_edges{{{0.5, 0, 0}, {0, 0.5, 0}}};  ///< of rectangles, orthogonal to each other
  float radius = 0;                                               ///< of spheres, which shine outwards
  std::shared_ptr<const EnvironmentMap> environment;              ///< null: the same from everywhere
  bool visible = true;         ///< of an environment: the camera sees it where nothing else is
  double rotation = 0;         ///< of an environment about +y, in radians, counter-clockwise seen from above
  std::uint32_t instance = 0;  ///< of meshes, in SceneFile::instances
};

enum class CameraType { perspective, orthographic };

class CameraMotion;

/// Looks along its local -z, +y up (glTF).
struct Camera {
  std::string name;
  CameraType type = CameraType::perspective;
  double yfov = 0.7853981633974483;  ///< radians, perspective
  double aspect = 0;                 ///< width / height; 0: the image's
  double xmag = 1, ymag = 1;         ///< half extents, orthographic
  double znear = 0;
  double zfar = std::numeric_limits<double>::infinity();
  Transform to_world = kIdentity;  ///< rotation and translation; any scale is removed
  /// What moves it over the frames of a sequence (see camera_at), shared by copies; null if it stays as it is here.
  std::shared_ptr<const CameraMotion> motion;
};

/// A point of a sequence. glTF animations go by seconds, setup files by frames, which need not be whole.
struct Moment {
  double frame = 0;
  double seconds = 0;
};

/// The camera at a moment: moved by its motion, whose ends hold before and after it, or as it is if nothing moves it.
/// Thread-safe. bad_input, in one line that names no file, if the camera has no direction then; `out` is as before.
UMBRIX_API Status camera_at(const Camera& camera, const Moment& moment, Camera& out);

/// From the first to the last key of what moves the camera: in seconds for a glTF animation's, in frames for a setup
/// file's; zeros if nothing does.
UMBRIX_API std::array<double, 2> motion_span(const Camera& camera);

class SceneMotion;

/// What a file holds, after all checks, at rest.
struct SceneFile {
  std::string path;
  std::vector<std::string> files;  ///< all that it is made of: this one, and those that it names
  std::string generator;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<TextureImage> images;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  std::vector<std::string> extensions_used;
  std::vector<std::string> ignored;  ///< one line for each kind of thing the file has and we do not use
  std::vector<std::string> warnings;
  std::vector<std::string> animations;  ///< their names
  /// What moves instances, lights and the shapes of meshes over the frames of a sequence (see pose_scene), shared by
  /// copies; null if nothing does.
  std::shared_ptr<const SceneMotion> motion;

  /// Triangles over all instances.
  UMBRIX_API std::uint64_t instanced_triangles() const noexcept;
};

/// Refused above these, before memory is asked for.
struct LoadLimits {
  std::uint64_t file_bytes = 4ull << 30;    ///< of the scene file, and of all its buffer files together
  std::uint64_t json_bytes = 256ull << 20;  ///< a .glb's JSON, or a whole .gltf with what is embedded in it
  std::uint64_t json_values = 1ull << 24;   ///< numbers, texts, arrays and objects in the JSON
  std::uint64_t list_elements = 1'000'000;  ///< of accessors, buffer views, meshes: each; of other lists a tenth
  std::uint64_t nodes = 1'000'000;
  std::uint32_t node_depth = 256;
  std::uint64_t triangles = 1ull << 29;  ///< over all instances
  std::uint64_t decoded_bytes = 0;       ///< of all accessors' values; 0: three quarters of the machine's memory
  std::uint64_t environment_pixels = 1ull << 27;  ///< 16384 x 8192
  std::uint64_t image_pixels = 1ull << 28;        ///< of each texture's image: 16384 x 16384
  std::uint64_t image_bytes = 0;                  ///< of all textures' images, decoded; 0: half of the machine's memory
  bool allow_paths_outside = false;               ///< files named by a file, outside its folder
};

/// Reads .gltf or .glb (told apart by content). On failure `out` is empty and the message names the file and what is
/// wrong in one line: bad_input, or resource_limit. Thread-safe for different `out`.
///
/// `animation` names the only one that is to move cameras and the scene, by its name or number from 0; invalid_argument
/// if the file has none such. Without it all do, but those that move what an earlier one in the file moves.
UMBRIX_API Status load_scene(const std::string& path, SceneFile& out, const LoadLimits& limits = {},
                             const std::string& animation = {});

/// What pose_scene changed.
struct SceneChanges {
  std::vector<std::uint32_t> meshes;     ///< that have another shape, ascending
  std::vector<std::uint32_t> instances;  ///< that have another place, or such a mesh, ascending
  bool lights = false;                   ///< whether any has another place or direction
};

/// Moves a scene to a moment: the transforms of instances, the places of lights, the positions and normals of meshes.
/// Nothing is added or removed, no array of another length, and the result does not depend on what moment the scene was
/// at. Cameras stay: camera_at moves them. bad_input, in one line that names no file, if something has no place then;
/// the scene is as before.
UMBRIX_API Status pose_scene(SceneFile& scene, const Moment& moment, SceneChanges& changes);

/// Of each instance: can pose_scene give it another place or shape?
UMBRIX_API std::vector<bool> moving_instances(const SceneFile& scene);

/// From the first to the last key of what moves the scene, in seconds; zeros if nothing does.
UMBRIX_API std::array<double, 2> motion_span(const SceneFile& scene);

/// Reads and decodes the images of textures that materials in use sample, and no others; in parallel, on oneTBB. An
/// image that is missing or damaged is left out with a line in `warnings`: its texture then is as if it were not there.
/// resource_limit for one beyond the limits. Not for one scene from two threads at once.
UMBRIX_API Status read_textures(SceneFile& scene, const LoadLimits& limits = {});

/// An image as its header describes it.
struct ImageInfo {
  std::string format;  ///< "png", "jpeg"
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;
};

/// Looks at the header of an image that is still encoded. Fails as load_scene does. Thread-safe.
UMBRIX_API Status describe_image(const SceneFile& scene, const TextureImage& image, ImageInfo& out,
                                 const LoadLimits& limits = {});

/// Camera and lights from outside the scene file.
struct Setup {
  std::optional<Camera> camera;
  std::vector<Light> lights;       ///< empty: keep the file's
  std::vector<std::string> files;  ///< all that were opened for it
};

/// Reads a setup file: an object {"camera": {...}, "lights": [...]}, or an array of such objects with "file" or "name"
/// of which the one that matches the scene's file name is taken. A camera is {eye, target, up, fov_y_degrees}, or
/// {keyframes: [...]}, which is as its first key until camera_at moves it.
/// A light is [x, y, z] (a point light of the default intensity for its position) or an object;
/// docs/setup.md has the format. Fails as load_scene does; limits are for what the file names.
UMBRIX_API Status load_setup(const std::string& path, const SceneFile& scene, Setup& out,
                             const LoadLimits& limits = {});

/// The intensity in candela that a light at `position` needs to give a white surface that faces it a radiance of 0.5 at
/// the median distance of what it may shine on (triangles weighted by area over squared distance).
UMBRIX_API float default_intensity(const SceneFile& scene, const Double3& position);

/// A camera that frames the scene, for files that have none.
UMBRIX_API Camera framing_camera(const SceneFile& scene);

/// Lights for files that have none: a sun over the camera's left shoulder, and a lamp at the camera, so that what is
/// seen is never black, in a closed room neither.
UMBRIX_API std::vector<Light> default_lights(const SceneFile& scene, const Camera& camera);

/// A light of type mesh for each instance whose material emits: its triangles shine on the side of their normals, on
/// both if the material is double-sided, with the radiance `emission`. It has the first name there is of instance, mesh
/// and material.
UMBRIX_API std::vector<Light> emissive_lights(const SceneFile& scene);

}  // namespace umbrix::io
