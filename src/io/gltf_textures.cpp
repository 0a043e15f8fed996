// SPDX-License-Identifier: Apache-2.0
// Textures, samplers and images (glTF 2.0 sections 3.8.2 to 3.8.4), the ways in which materials use them, and
// KHR_texture_transform. Images are found here and stay encoded.

#include <cmath>
#include <map>

#include "io/accessor.h"
#include "io/gltf_convert.h"
#include "io/gltf_parse.h"
#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

constexpr double kLargest = 1e9;  // of a transform's members: beyond it coordinates have no digits left for texels

Wrap wrap_of(int value, const std::string& label) {
  switch (value) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirror;
    default:
      bad_input("{}: {} is no way to wrap", label, value);
  }
}

double number(const tinygltf::Value& object, const char* member, int element, double otherwise) {
  if (!object.Has(member)) return otherwise;
  const tinygltf::Value& value = object.Get(member);
  return value.IsArray() ? value.Get(element).GetNumberAsDouble() : value.GetNumberAsDouble();
}

// The extension's angle turns coordinates counter-clockwise as seen on the image, whose v points down.
void read_transform(const tinygltf::Value& transform, TextureUse& use, const std::string& label) {
  const double values[] = {number(transform, "offset", 0, 0), number(transform, "offset", 1, 0),
                           number(transform, "scale", 0, 1), number(transform, "scale", 1, 1),
                           number(transform, "rotation", 0, 0)};
  for (const double value : values) {
    if (!(std::abs(value) <= kLargest)) {
      bad_input("{}: a number of KHR_texture_transform is {}, beyond {}", label, value, kLargest);
    }
  }
  const double c = std::cos(values[4]), s = std::sin(values[4]);
  use.transform = {{{c * values[2], s * values[3], values[0]}, {-s * values[2], c * values[3], values[1]}}};
  if (transform.Has("texCoord")) use.texcoord = static_cast<std::uint32_t>(transform.Get("texCoord").GetNumberAsInt());
}

std::shared_ptr<const std::vector<unsigned char>> shared(std::vector<unsigned char> bytes) {
  return std::make_shared<const std::vector<unsigned char>>(std::move(bytes));
}

}  // namespace

TextureUse convert_texture_use(Conversion& conversion, int texture, int texcoord,
                               const tinygltf::ExtensionMap& extensions, const std::string& label) {
  TextureUse use;
  if (texture < 0) return use;
  use.texture = texture;
  use.texcoord = static_cast<std::uint32_t>(texcoord);
  const auto transform = extensions.find("KHR_texture_transform");
  if (transform != extensions.end()) read_transform(transform->second, use, label);
  if (use.texcoord > 1) {
    conversion.ignored.add("textures by a third or further set of texture coordinates", label);
    return {};
  }
  if (conversion.scene.textures[static_cast<std::size_t>(texture)].image < 0) {
    conversion.ignored.add("textures without an image in PNG or JPEG", label);
    return {};
  }
  return use;
}

void convert_textures(Conversion& conversion) {
  std::size_t number = 0;
  for (const tinygltf::Texture& in : conversion.model.textures) {
    const std::string label = label_of("textures", number++, in.name);
    Texture out;
    out.image = in.source;
    if (in.sampler >= 0) {
      const tinygltf::Sampler& sampler = conversion.model.samplers[static_cast<std::size_t>(in.sampler)];
      out.sampler.wrap_u = wrap_of(sampler.wrapS, label);
      out.sampler.wrap_v = wrap_of(sampler.wrapT, label);
      out.sampler.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    conversion.scene.textures.push_back(out);
  }
}

void convert_images(Conversion& conversion) {
  std::map<int, std::shared_ptr<const std::vector<unsigned char>>> views;  // many images may name one
  std::size_t number = 0;
  for (const tinygltf::Image& in : conversion.model.images) {
    const std::string label = label_of("images", number++, in.name);
    TextureImage out;
    out.name = in.name;
    if (in.bufferView >= 0) {
      auto& bytes = views[in.bufferView];
      if (!bytes) bytes = shared(view_bytes(conversion.model, in.bufferView, label));
      out.encoded = bytes;
    } else if (!in.image.empty()) {
      out.encoded = shared(in.image);
    } else {
      out.file = uri_path(conversion.scene.path, in.uri, label, conversion.limits);
      conversion.scene.files.push_back(out.file);
    }
    conversion.scene.images.push_back(std::move(out));
  }
}

}  // namespace umbrix::io::detail
