// SPDX-License-Identifier: Apache-2.0
// The committed scenes are what the generator makes, and what scenes/README.md promises.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "umbrix/io/scene_file.h"

namespace umbrix {
namespace {

namespace fs = std::filesystem;

const char* const kNames[] = {"atrium", "bedroom", "conference", "cornell", "forest"};

fs::path committed(const std::string& name) { return fs::path(UMBRIX_OWN_SCENES_DIR) / (name + ".glb"); }

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

io::SceneFile load(const std::string& name) {
  io::SceneFile scene;
  const Status status = io::load_scene(committed(name).string(), scene);
  EXPECT_TRUE(status.ok()) << status.message();
  return scene;
}

/// A folder of its own that goes away with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(fs::temp_directory_path() / ("umbrix_scenes_" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

int generate(const std::string& arguments) {
  return std::system(("\"" UMBRIX_SCENE_GENERATOR "\" " + arguments + " > /dev/null 2>&1").c_str());
}

TEST(Scenes, GeneratorMakesTheCommittedBytes) {
  const TemporaryFolder folder;
  ASSERT_EQ(generate('"' + folder.path().string() + '"'), 0);
  for (const std::string name : kNames) {
    // Not EXPECT_EQ on the strings: a failure would print a megabyte.
    EXPECT_TRUE(bytes_of(folder.path() / (name + ".glb")) == bytes_of(committed(name)))
        << name << ".glb differs; if that is meant, run umbrix_scenes on scenes/ and commit";
  }
  const auto files = std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
  EXPECT_EQ(static_cast<std::size_t>(files), std::size(kNames)) << "a scene is missing from this test";
}

TEST(Features, GeneratorMakesTheCommittedBytes) {
  const TemporaryFolder folder;
  ASSERT_EQ(std::system(("\"" UMBRIX_FEATURE_GENERATOR "\" \"" + folder.path().string() + "\"").c_str()), 0);
  for (const auto& entry : fs::directory_iterator(UMBRIX_FEATURES_DIR)) {
    const fs::path name = entry.path().filename();
    // What compression makes of the same mesh depends on the encoder's version, and a build need not have one.
    if (name == "BoxDraco.gltf" || name == "MeshoptBox.gltf") continue;
    EXPECT_EQ(bytes_of(folder.path() / name), bytes_of(entry.path()))
        << "if that is meant, run umbrix_feature_files on the folder and commit";
  }
}

TEST(Scenes, GeneratorMakesOnlyWhatIsAskedFor) {
  const TemporaryFolder folder;
  ASSERT_EQ(generate('"' + folder.path().string() + "\" cornell"), 0);
  EXPECT_TRUE(fs::exists(folder.path() / "cornell.glb"));
  EXPECT_FALSE(fs::exists(folder.path() / "atrium.glb"));
  EXPECT_NE(generate('"' + folder.path().string() + "\" no_such_scene"), 0);
  EXPECT_NE(generate('"' + (folder.path() / "no_such_folder").string() + '"'), 0);
}

TEST(Scenes, AreSmallFiles) {
  std::uintmax_t total = 0;
  for (const std::string name : kNames) {
    const std::uintmax_t size = fs::file_size(committed(name));
    EXPECT_LT(size, 1'000'000u) << name;
    total += size;
  }
  EXPECT_LT(total, 3'000'000u);
}

TEST(Scenes, LoadWithCameraAndLightsAndNothingIgnored) {
  bool has_spot = false, has_directional = false, has_point = false;
  for (const std::string name : kNames) {
    SCOPED_TRACE(name);
    const io::SceneFile scene = load(name);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_GE(scene.lights.size(), 2u);
    EXPECT_LE(scene.lights.size(), 4u);
    EXPECT_GE(scene.instanced_triangles(), 10'000u);
    EXPECT_LE(scene.instanced_triangles(), 500'000u);
    for (const std::string& line : scene.ignored) ADD_FAILURE() << "ignored: " << line;
    for (const std::string& line : scene.warnings) ADD_FAILURE() << "warning: " << line;
    for (const io::Light& light : scene.lights) {
      has_spot |= light.type == io::LightType::spot;
      has_directional |= light.type == io::LightType::directional;
      has_point |= light.type == io::LightType::point;
    }
  }
  EXPECT_TRUE(has_spot && has_directional && has_point);
}

TEST(Scenes, SomeAreQuantizedAndSomeAreNot) {
  const auto is_quantized = [](const std::string& name) {
    const std::vector<std::string> used = load(name).extensions_used;
    return std::find(used.begin(), used.end(), "KHR_mesh_quantization") != used.end();
  };
  EXPECT_TRUE(is_quantized("forest"));
  EXPECT_TRUE(is_quantized("bedroom"));
  EXPECT_FALSE(is_quantized("cornell"));
}

io::Double3 cross_of_edges(const io::Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  io::Double3 e{}, f{};
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = double{mesh.positions[triangle[1]][k]} - double{mesh.positions[triangle[0]][k]};
    f[k] = double{mesh.positions[triangle[2]][k]} - double{mesh.positions[triangle[0]][k]};
  }
  return {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
}

TEST(Scenes, TrianglesHaveAnAreaAndNormalsUnitLength) {
  for (const std::string name : kNames) {
    SCOPED_TRACE(name);
    std::size_t without_area = 0, odd_normals = 0;
    for (const io::Mesh& mesh : load(name).meshes) {
      for (const auto& triangle : mesh.triangles) without_area += cross_of_edges(mesh, triangle) == io::Double3{};
      for (const io::Float3& n : mesh.normals) {
        const float length2 = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        odd_normals += !(length2 > 0.97f && length2 < 1.03f);
      }
    }
    EXPECT_EQ(without_area, 0u);
    EXPECT_EQ(odd_normals, 0u);
  }
}

/// Six times the volume a mesh encloses; positive if its triangles face outwards.
double volume(const io::Mesh& mesh) {
  double sum = 0;
  for (const auto& triangle : mesh.triangles) {
    const io::Double3 area = cross_of_edges(mesh, triangle);
    for (std::size_t k = 0; k < 3; ++k) sum += area[k] * double{mesh.positions[triangle[0]][k]};
  }
  return sum;
}

/// Every directed edge, as pairs of corner positions, must be met by its reverse.
bool is_closed(const io::Mesh& mesh) {
  std::vector<std::array<io::Float3, 2>> forward, backward;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const io::Float3 a = mesh.positions[triangle[k]], b = mesh.positions[triangle[(k + 1) % 3]];
      forward.push_back({a, b});
      backward.push_back({b, a});
    }
  }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  return forward == backward;
}

TEST(Scenes, SolidsAreWatertightAndFaceOutwards) {
  for (const std::string name : kNames) {
    SCOPED_TRACE(name);
    const io::SceneFile scene = load(name);
    std::size_t closed = 0;
    for (const io::Mesh& mesh : scene.meshes) {
      const bool is_sheet = scene.materials[mesh.material].double_sided || mesh.name.rfind("sky", 0) == 0;
      if (is_sheet) continue;
      EXPECT_TRUE(is_closed(mesh)) << mesh.name;
      EXPECT_GT(volume(mesh), 0) << mesh.name;
      ++closed;
    }
    EXPECT_GT(closed, 5u);
  }
}

}  // namespace
}  // namespace umbrix
