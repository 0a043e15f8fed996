// SPDX-License-Identifier: Apache-2.0
// Materials (glTF 2.0 section 3.9), cameras (3.10) and KHR_lights_punctual: numbers in, numbers out, ranges checked.

#include <algorithm>
#include <cmath>

#include "io/gltf_convert.h"
#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A number of the file as float; refuses what is outside [low, high].
float checked(double value, double low, double high, const char* what, const std::string& label) {
  if (!(value >= low && value <= high)) bad_input("{}: {} is {}, must be from {} to {}", label, what, value, low, high);
  return static_cast<float>(value);
}

constexpr double kLargest = std::numeric_limits<float>::max();

// A number of an extension of the material, or what it is without one.
float extension_number(const tinygltf::Material& material, const char* extension, const char* member, double otherwise,
                       double low, double high, const std::string& label) {
  const auto found = material.extensions.find(extension);
  const bool there = found != material.extensions.end() && found->second.Has(member);
  return checked(there ? found->second.Get(member).GetNumberAsDouble() : otherwise, low, high, member, label);
}

AlphaMode alpha_mode(const std::string& name, const std::string& label) {
  if (name == "OPAQUE") return AlphaMode::opaque;
  if (name == "MASK") return AlphaMode::mask;
  if (name == "BLEND") return AlphaMode::blend;
  bad_input("{}: alphaMode '{}' is none of OPAQUE, MASK, BLEND", label, printable(name, 32));
}

void convert_emission(const tinygltf::Material& in, const std::string& label, Material& out) {
  if (in.emissiveFactor.size() != 3) return;
  const float strength =
      extension_number(in, "KHR_materials_emissive_strength", "emissiveStrength", 1, 0, kLargest, label);
  for (std::size_t c = 0; c < 3; ++c) {
    // Old exporters put strengths above one here.
    const float factor = checked(in.emissiveFactor[c], 0, kLargest, "emissiveFactor", label);
    out.emission[c] = checked(static_cast<double>(factor) * strength, 0, kLargest, "emission", label);
  }
}

// A texture of an extension, whose members tinygltf leaves as they are.
TextureUse extension_texture(Conversion& conversion, const tinygltf::Value& extension, const char* member,
                             const std::string& label) {
  if (!extension.Has(member)) return {};
  const tinygltf::Value& info = extension.Get(member);
  tinygltf::ExtensionMap extensions;
  if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform")) {
    extensions["KHR_texture_transform"] = info.Get("extensions").Get("KHR_texture_transform");
  }
  const int texcoord = info.Has("texCoord") ? info.Get("texCoord").GetNumberAsInt() : 0;
  return convert_texture_use(conversion, info.Get("index").GetNumberAsInt(), texcoord, extensions, label);
}

void convert_specular(Conversion& conversion, const tinygltf::Material& in, const std::string& label, Material& out) {
  out.ior = extension_number(in, "KHR_materials_ior", "ior", 1.5, 0, kLargest, label);
  if (out.ior > 0 && out.ior < 1) bad_input("{}: ior is {}, must be 0 or from 1 up", label, out.ior);
  const auto found = in.extensions.find("KHR_materials_specular");
  if (found == in.extensions.end()) return;
  const tinygltf::Value& specular = found->second;
  out.specular = extension_number(in, "KHR_materials_specular", "specularFactor", 1, 0, 1, label);
  if (specular.Has("specularColorFactor")) {
    for (std::size_t c = 0; c < 3; ++c) {
      const tinygltf::Value& value = specular.Get("specularColorFactor").Get(static_cast<int>(c));
      out.specular_color[c] = checked(value.GetNumberAsDouble(), 0, kLargest, "specularColorFactor", label);
    }
  }
  out.specular_texture = extension_texture(conversion, specular, "specularTexture", label);
  out.specular_color_texture = extension_texture(conversion, specular, "specularColorTexture", label);
}

void convert_texture_uses(Conversion& conversion, const tinygltf::Material& in, const std::string& label,
                          Material& out) {
  const auto use = [&](const auto& info) {
    return convert_texture_use(conversion, info.index, info.texCoord, info.extensions, label);
  };
  out.base_color_texture = use(in.pbrMetallicRoughness.baseColorTexture);
  if (out.unlit) return;
  out.metallic_roughness_texture = use(in.pbrMetallicRoughness.metallicRoughnessTexture);
  out.normal_texture = use(in.normalTexture);
  if (out.normal_texture.texture >= 0) {
    out.normal_scale = checked(in.normalTexture.scale, -kLargest, kLargest, "scale of normalTexture", label);
  }
  if (out.emission != Float3{0, 0, 0}) out.emissive_texture = use(in.emissiveTexture);
  if (in.occlusionTexture.index >= 0) {
    conversion.ignored.add("occlusion textures (rays find what is occluded)", label);
  }
}

Material convert_material(Conversion& conversion, const tinygltf::Material& in, const std::string& label) {
  const tinygltf::PbrMetallicRoughness& pbr = in.pbrMetallicRoughness;
  Material out;
  out.name = in.name;
  if (pbr.baseColorFactor.size() == 4) {
    for (std::size_t c = 0; c < 3; ++c) {
      out.base_color[c] = checked(pbr.baseColorFactor[c], 0, 1, "baseColorFactor", label);
    }
    out.alpha = checked(pbr.baseColorFactor[3], 0, 1, "baseColorFactor", label);
  }
  out.metallic = checked(pbr.metallicFactor, 0, 1, "metallicFactor", label);
  out.roughness = checked(pbr.roughnessFactor, 0, 1, "roughnessFactor", label);
  out.double_sided = in.doubleSided;
  out.alpha_mode = alpha_mode(in.alphaMode, label);
  out.alpha_cutoff = checked(in.alphaCutoff, 0, kLargest, "alphaCutoff", label);
  out.unlit = in.extensions.count("KHR_materials_unlit") > 0;
  if (!out.unlit) {
    convert_emission(in, label, out);
    convert_specular(conversion, in, label, out);
  }
  convert_texture_uses(conversion, in, label, out);
  return out;
}

}  // namespace

void convert_materials(Conversion& conversion) {
  std::size_t number = 0;
  for (const tinygltf::Material& material : conversion.model.materials) {
    const std::string label = label_of("materials", number++, material.name);
    conversion.scene.materials.push_back(convert_material(conversion, material, label));
  }
}

Camera convert_camera(const tinygltf::Camera& in, const std::string& label) {
  Camera out;
  out.name = in.name;
  double zfar = 0;
  if (in.type == "perspective") {
    out.type = CameraType::perspective;
    out.yfov = in.perspective.yfov;
    out.aspect = in.perspective.aspectRatio;
    out.znear = in.perspective.znear;
    zfar = in.perspective.zfar;
    if (!(out.yfov > 0 && out.yfov < kPi)) bad_input("{}: yfov is {}, must be between 0 and pi", label, out.yfov);
    if (!(out.aspect >= 0)) bad_input("{}: aspectRatio is {}, must not be negative", label, out.aspect);
    if (zfar == 0) zfar = std::numeric_limits<double>::infinity();
  } else if (in.type == "orthographic") {
    out.type = CameraType::orthographic;
    // Negative magnifications mirror the image; glTF advises against them.
    out.xmag = std::abs(in.orthographic.xmag);
    out.ymag = std::abs(in.orthographic.ymag);
    out.znear = in.orthographic.znear;
    zfar = in.orthographic.zfar;
    if (!(out.xmag > 0 && out.ymag > 0)) bad_input("{}: xmag and ymag must not be 0", label);
  } else {
    bad_input("{}: type '{}' is neither perspective nor orthographic", label, printable(in.type, 32));
  }
  if (!(out.znear >= 0 && zfar > out.znear)) {
    bad_input("{}: znear {} and zfar {} are not in order", label, out.znear, zfar);
  }
  out.zfar = zfar;
  return out;
}

Light convert_light(const tinygltf::Light& in, const std::string& label) {
  Light out;
  out.name = in.name;
  if (!find_light_type(in.type, out.type) || light_type_info(out.type).has(kHasArea)) {
    bad_input("{}: there is no type '{}'", label, printable(in.type, 32));
  }
  if (in.color.size() == 3) {
    for (std::size_t c = 0; c < 3; ++c) out.color[c] = checked(in.color[c], 0, kLargest, "color", label);
  }
  out.intensity = checked(in.intensity, 0, kLargest, "intensity", label);
  // tinygltf gives 0 for a light without a range.
  if (in.range != 0) out.range = checked(in.range, 0, kLargest, "range", label);
  if (light_type_info(out.type).has(kHasCone)) {
    out.outer_cone_angle = checked(in.spot.outerConeAngle, 0, kPi / 2 + 1e-6, "outerConeAngle", label);
    out.inner_cone_angle = checked(in.spot.innerConeAngle, 0, in.spot.outerConeAngle, "innerConeAngle", label);
    if (out.outer_cone_angle == 0) bad_input("{}: outerConeAngle is 0", label);
  }
  return out;
}

}  // namespace umbrix::io::detail
