// SPDX-License-Identifier: Apache-2.0
//
// Real scenes: every kernel against Embree on shadow rays. Where they differ, exact arithmetic decides, and it must
// decide for us. Embree's own errors are printed. Three kernels answer all rays, the others every tenth of them, but
// none in the largest scenes: what they are prepared with takes long to make there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "cases/meshes.h"
#include "embree/embree_scene.h"
#include "oracle/brute_force.h"
#include "test_rays.h"
#include "umbrix/umbrix.h"
#include "workload/geometry.h"
#include "workload/shadow_rays.h"

namespace umbrix {
namespace {

namespace fs = std::filesystem;

fs::path own_folder() { return fs::path(UMBRIX_SOURCE_DIR) / "scenes"; }

fs::path shared_folder() {
  const char* folder = std::getenv("UMBRIX_SCENES_DIR");
  return folder != nullptr ? folder : UMBRIX_SHARED_SCENES;
}

// The project's own scenes and those beside the checkout; the folder's own name stands for scenes that are absent.
std::vector<std::string> scene_paths() {
  std::vector<std::string> paths;
  for (const fs::path& folder : {own_folder(), shared_folder()}) {
    std::error_code error;
    const std::size_t before = paths.size();
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".glb") paths.push_back(entry.path().string());
    }
    if (paths.size() == before) paths.push_back(folder.string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

// Rays to the lights in turn, at growing resolutions, until there are enough.
std::vector<Ray> enough_shadow_rays(const Scene& scene, const workload::Geometry& geometry,
                                    const workload::Viewpoint& viewpoint, std::size_t wanted) {
  std::vector<Ray> rays;
  const int first_size = wanted < 10'000 ? 64 : 512;
  for (int size = first_size; rays.size() < wanted && size <= 8 * first_size; size = size * 3 / 2) {
    for (const io::Light& light : viewpoint.lights) {
      const std::vector<Ray> more = workload::shadow_rays(scene, geometry, viewpoint.camera, light, size);
      rays.insert(rays.end(), more.begin(), more.end());
      if (rays.size() >= wanted) break;
    }
  }
  return rays;
}

// Rays on which float tracers err: from the lights and the eye at corners and edges of triangles, and beyond.
std::vector<Ray> edge_rays(const workload::Geometry& geometry, const workload::Viewpoint& viewpoint,
                           std::size_t count) {
  cases::Random random(1);
  const auto& camera = viewpoint.camera.to_world;
  std::vector<cases::Float3> origins = {
      {static_cast<float>(camera[0][3]), static_cast<float>(camera[1][3]), static_cast<float>(camera[2][3])}};
  for (const io::Light& light : viewpoint.lights) {
    if (light.type == io::LightType::directional) continue;
    origins.push_back({static_cast<float>(light.position[0]), static_cast<float>(light.position[1]),
                       static_cast<float>(light.position[2])});
  }
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const auto mesh = static_cast<std::uint32_t>(random.below(geometry.meshes.size()));
    const auto triangle = static_cast<std::uint32_t>(random.below(geometry.meshes[mesh].triangles.size()));
    const cases::Float3 target = cases::point_on(geometry.triangle({mesh, triangle}), random);
    rays.push_back(cases::ray_to(origins[random.below(origins.size())], target, 0, 1.25f));
  }
  return rays;
}

constexpr std::size_t kShareOfMost = 10;
constexpr std::size_t kFewTriangles = 1'500'000;

bool answers_all(const std::string& kernel) { return kernel == "auto" || kernel == "standard" || kernel == "linked"; }

std::vector<Ray> every_tenth(const std::vector<Ray>& rays) {
  std::vector<Ray> result;
  for (std::size_t i = 0; i < rays.size(); i += kShareOfMost) result.push_back(rays[i]);
  return result;
}

// Holds some kernels to Embree's answers, or to the truth where they differ. Returns how often Embree is wrong.
std::size_t expect_right(const Scene& scene, const embree::EmbreeScene& embree_scene, const oracle::BruteForce& truth,
                         const std::vector<Ray>& rays, const std::vector<std::string>& kernels) {
  std::vector<std::uint8_t> theirs(rays.size()), ours(rays.size());
  embree_scene.occluded({rays.data(), rays.size()}, embree::Mode::single, theirs.data());
  std::size_t embree_wrong = 0;
  for (const std::string& kernel : kernels) {
    SCOPED_TRACE(kernel);
    QueryOptions options;
    EXPECT_TRUE(find_kernel(kernel.c_str(), options.kernel).ok());
    scene.occluded({rays.data(), rays.size()}, ours.data(), options);
    std::vector<Ray> disputed;
    std::vector<std::uint8_t> answers;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (ours[i] == theirs[i]) continue;
      disputed.push_back(rays[i]);
      answers.push_back(ours[i]);
    }
    const std::vector<std::uint8_t> right = truth.occluded(disputed);
    EXPECT_EQ(answers, right) << "of " << rays.size() << " rays, those disputed with Embree";
    embree_wrong = 0;
    for (std::size_t i = 0; i < right.size(); ++i) embree_wrong += answers[i] == right[i] ? 1 : 0;
  }
  return embree_wrong;
}

// Every kernel, or of many triangles some; returns how often Embree is wrong.
std::size_t expect_all_right(Scene& scene, std::size_t triangles, const embree::EmbreeScene& embree_scene,
                             const oracle::BruteForce& truth, const std::vector<Ray>& rays) {
  const std::vector<Ray> fewer = every_tenth(rays);
  Training training;
  training.rays = {fewer.data(), fewer.size()};
  std::vector<std::string> first, others;
  for (std::size_t k = 0; k < kernel_count(); ++k) {
    const std::string kernel = kernel_info(k).name;
    if (kernel == "brute" || (triangles > kFewTriangles && !answers_all(kernel))) continue;
    EXPECT_TRUE(scene.prepare({static_cast<int>(k)}, training).ok()) << kernel;
    (answers_all(kernel) ? first : others).push_back(kernel);
  }
  expect_right(scene, embree_scene, truth, fewer, others);
  return expect_right(scene, embree_scene, truth, rays, first);
}

class SceneAgainstEmbree : public testing::TestWithParam<std::string> {};

TEST_P(SceneAgainstEmbree, NoKernelIsWrong) {
  if (fs::path(GetParam()).extension() != ".glb") GTEST_SKIP() << "no scenes in " << GetParam();
  workload::Geometry geometry;
  Status status = workload::load_geometry(GetParam(), geometry);
  ASSERT_TRUE(status.ok()) << status.message();
  const fs::path setup = fs::path(GetParam()).parent_path() / "scenes.json";
  workload::Viewpoint viewpoint;
  status = workload::find_viewpoint(geometry, fs::exists(setup) ? setup.string() : "", viewpoint);
  ASSERT_TRUE(status.ok()) << status.message();

  const std::vector<MeshView> views = geometry.views();
  Scene scene;
  embree::EmbreeScene embree_scene;
  status = workload::build_scene(views, {}, scene);
  ASSERT_TRUE(status.ok()) << status.message();
  status = embree_scene.build(views, {});
  ASSERT_TRUE(status.ok()) << status.message();
  const std::size_t wanted = test_rays(200'000);
  const std::vector<Ray> rays = enough_shadow_rays(scene, geometry, viewpoint, wanted);
  ASSERT_GE(rays.size(), wanted);

  const oracle::BruteForce truth(geometry.triangle_list());
  const std::size_t wrong = expect_all_right(scene, geometry.triangle_count(), embree_scene, truth, rays);
  const std::vector<Ray> edges = edge_rays(geometry, viewpoint, wanted / 20);
  const std::size_t wrong_at_edges = expect_all_right(scene, geometry.triangle_count(), embree_scene, truth, edges);
  std::cout << geometry.name << ": Embree wrong on " << wrong << " of " << rays.size() << " shadow rays, "
            << wrong_at_edges << " of " << edges.size() << " rays at edges and corners\n";
}

std::string scene_name(const testing::TestParamInfo<std::string>& parameter) {
  const fs::path path = parameter.param;
  std::string name = (path.parent_path() == own_folder() ? "own_" : "shared_") + path.stem().string();
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneAgainstEmbree, testing::ValuesIn(scene_paths()), scene_name);

}  // namespace
}  // namespace umbrix
