// SPDX-License-Identifier: Apache-2.0
// Images of textures, decoded to bytes: those that something samples, in parallel. (PNG may hold sixteen bits, of which
// the upper eight are kept, as elsewhere in real time.)

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <new>
#include <set>

#include "io/gltf_convert.h"
#include "io/image_input.h"
#include "io/input_file.h"
#include "io/load_error.h"
#include "io/memory_share.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::io {
namespace detail {
namespace {

// The encoded bytes, of a file or of what the scene file holds.
std::shared_ptr<const std::vector<unsigned char>> bytes_of(const TextureImage& image, const LoadLimits& limits) {
  if (image.file.empty()) return image.encoded;
  return std::make_shared<const std::vector<unsigned char>>(read_file(image.file, limits.file_bytes));
}

// Images of textures of materials of meshes that are placed.
std::vector<std::uint32_t> images_in_use(const SceneFile& scene) {
  std::vector<bool> seen(scene.materials.size());
  for (const Instance& instance : scene.instances) seen[scene.meshes[instance.mesh].material] = true;
  std::set<std::uint32_t> images;
  for (std::size_t m = 0; m < seen.size(); ++m) {
    for (const auto use : kMaterialTextures) {
      const std::int32_t texture = (scene.materials[m].*use).texture;
      if (seen[m] && texture >= 0) {
        images.insert(static_cast<std::uint32_t>(scene.textures[static_cast<std::size_t>(texture)].image));
      }
    }
  }
  return {images.begin(), images.end()};
}

// Bytes that all images may take together, taken by each before it asks for memory.
class Budget {
 public:
  explicit Budget(std::uint64_t bytes)
      : bytes_(std::min(bytes, std::uint64_t{1} << 62)), left_(static_cast<std::int64_t>(bytes_)) {}

  // Whether all fit does not depend on their order.
  void spend(std::uint64_t bytes) {
    if ((left_ -= static_cast<std::int64_t>(bytes)) < 0) {
      over_limit("the textures' images take more than {} bytes, which is the limit", bytes_);
    }
  }

 private:
  std::uint64_t bytes_;
  std::atomic<std::int64_t> left_;
};

void decode(TextureImage& image, const LoadLimits& limits, Budget& budget) {
  const auto bytes = bytes_of(image, limits);
  EncodedImage encoded(*bytes, limits.image_pixels);
  const OIIO::ImageSpec& spec = encoded.input->spec();
  const auto channels = static_cast<std::uint64_t>(spec.nchannels);
  const std::uint64_t size =
      static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height) * channels;
  budget.spend(size);
  std::vector<std::uint8_t> pixels(size);
  if (!encoded.input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data())) {
    bad_input("{}", one_line(encoded.input->geterror()));
  }
  image.width = static_cast<std::uint32_t>(spec.width);
  image.height = static_cast<std::uint32_t>(spec.height);
  image.channels = static_cast<std::uint32_t>(spec.nchannels);
  image.pixels = std::move(pixels);
  image.encoded.reset();
}

// What became of one image.
Status try_decode(TextureImage& image, const std::string& label, const LoadLimits& limits, Budget& budget) {
  try {
    decode(image, limits, budget);
    return {};
  } catch (const LoadError& e) {
    return {e.code, fmt::format("{}: {}", label, e.what)};
  } catch (const std::bad_alloc&) {
    return out_of_memory(label);
  } catch (const std::exception& e) {
    return {StatusCode::bad_input, fmt::format("{}: {}", label, one_line(e.what()))};
  }
}

}  // namespace
}  // namespace detail

Status read_textures(SceneFile& scene, const LoadLimits& limits) try {
  using namespace detail;
  const std::vector<std::uint32_t> images = images_in_use(scene);
  std::vector<Status> outcomes(images.size());
  Budget budget(limits.image_bytes > 0 ? limits.image_bytes : memory_share(1, 2));
  tbb::parallel_for(std::size_t{0}, images.size(), [&](std::size_t i) {
    TextureImage& image = scene.images[images[i]];
    if (!image.pixels.empty()) return;
    const std::string name = image.file.empty() ? image.name : image.file;
    outcomes[i] = try_decode(image, label_of("images", images[i], name), limits, budget);
  });
  for (const Status& outcome : outcomes) {
    if (outcome.ok()) continue;
    if (outcome.code() == StatusCode::resource_limit) {
      return {outcome.code(), fmt::format("{}: {}", printable(scene.path), outcome.message())};
    }
    scene.warnings.push_back(outcome.message() + "; materials do without it");
  }
  return {};
} catch (const std::bad_alloc&) {
  return detail::out_of_memory(scene.path);
} catch (const std::exception& e) {  // oneTBB's, where it can make no thread
  return {StatusCode::resource_limit, detail::printable(scene.path) + ": " + detail::one_line(e.what())};
}

Status describe_image(const SceneFile& scene, const TextureImage& image, ImageInfo& out, const LoadLimits& limits) try {
  using namespace detail;
  out = {};
  const auto bytes = bytes_of(image, limits);
  if (!bytes) return {StatusCode::invalid_argument, "the image is read already"};
  const EncodedImage encoded(*bytes, limits.image_pixels);
  const OIIO::ImageSpec& spec = encoded.input->spec();
  out = {encoded.input->format_name(), static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height),
         static_cast<std::uint32_t>(spec.nchannels)};
  return {};
} catch (const detail::LoadError& e) {
  return {e.code, fmt::format("{}: {}", detail::printable(image.file.empty() ? scene.path : image.file), e.what)};
} catch (const std::bad_alloc&) {
  return detail::out_of_memory(scene.path);
} catch (const std::exception& e) {
  return {StatusCode::bad_input, detail::printable(scene.path) + ": " + detail::one_line(e.what())};
}

}  // namespace umbrix::io
