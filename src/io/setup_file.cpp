// SPDX-License-Identifier: Apache-2.0
// Camera and lights from a JSON file of ours; docs/setup.md describes it.

#include <filesystem>
#include <new>

#include "io/gltf_document.h"
#include "io/input_file.h"
#include "io/load_error.h"
#include "io/setup_camera.h"
#include "io/setup_lights.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::io {
namespace detail {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMostBytes = 64u << 20;

// Of several entries, the one for this scene; a single object is for every scene.
const json& find_entry(const json& root, const std::string& scene_path) {
  if (root.is_object()) return root;
  if (!root.is_array()) bad_input("is neither an object nor an array of objects");
  const std::filesystem::path path(scene_path);
  const auto says = [](const json& entry, const char* name, const std::string& value) {
    const auto found = entry.find(name);
    return found != entry.end() && found->is_string() && found->get_ref<const std::string&>() == value;
  };
  for (const json& entry : root) {
    if (!entry.is_object()) bad_input("is an array, but not of objects");
    if (says(entry, "file", path.filename().string()) || says(entry, "name", path.stem().string())) return entry;
  }
  bad_input("has no entry whose \"file\" is {} or whose \"name\" is {}", printable(path.filename().string(), 128),
            printable(path.stem().string(), 128));
}

}  // namespace

void read_setup(const std::string& path, const SceneFile& scene, const LoadLimits& limits, Setup& out) {
  const OpenedFiles record(out.files);
  const std::vector<unsigned char> bytes = read_file(path, kMostBytes);
  const json root = parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const json& entry = find_entry(root, scene.path);
  if (!entry.contains("camera") && !entry.contains("lights")) bad_input("has neither a camera nor lights");
  if (entry.contains("camera")) out.camera = read_setup_camera(entry.at("camera"));
  if (entry.contains("lights")) out.lights = read_setup_lights(entry.at("lights"), {path, scene, limits});
}

}  // namespace detail

Status load_setup(const std::string& path, const SceneFile& scene, Setup& out, const LoadLimits& limits) {
  out = {};
  const auto failed = [&](StatusCode code, const std::string& what) {
    out = {};
    return Status(code, detail::printable(path) + ": " + what);
  };
  try {
    detail::read_setup(path, scene, limits, out);
    return {};
  } catch (const detail::LoadError& e) {
    return failed(e.code, e.what);
  } catch (const std::bad_alloc&) {
    out = {};
    return detail::out_of_memory(path);
  } catch (const std::exception& e) {
    return failed(StatusCode::bad_input, detail::one_line(e.what()));
  }
}

}  // namespace umbrix::io
