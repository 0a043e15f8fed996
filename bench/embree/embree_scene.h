// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "umbrix/mesh.h"
#include "umbrix/ray.h"
#include "umbrix/status.h"

/// Embree 3 or 4, whichever the build found, asked only what Umbrix is asked.
namespace umbrix::embree {

enum class Quality { medium, high };

struct Options {
  Quality quality = Quality::high;
  bool robust = true;  ///< RTC_SCENE_FLAG_ROBUST
  int threads = 0;     ///< for the build; 0: all
};

/// The ways to hand Embree many rays.
enum class Mode { single, packet8, packet16, packet16_coherent, stream_coherent, stream_incoherent };

/// Those of the linked version: Embree 4 has no streams.
const std::vector<Mode>& modes();

/// "single", "8", "16", "16-coherent", "stream-coherent", "stream-incoherent".
const char* mode_name(Mode mode);

/// "3.13.5".
const char* version();

/// Whether Embree takes the ray at all: finite, no magnitude above 1.844e18, and 0 <= tmin (Debian's build asserts it).
bool accepts(const Ray& ray);

/// Triangles in Embree's tree. After build, occluded may be called from any number of threads.
class EmbreeScene {
 public:
  EmbreeScene() noexcept;
  ~EmbreeScene();
  EmbreeScene(EmbreeScene&&) noexcept;
  EmbreeScene& operator=(EmbreeScene&&) noexcept;

  /// Copies the meshes and builds. Masks and opacity are not used.
  Status build(const std::vector<MeshView>& meshes, const Options& options);

  /// out[i] = 1 if rays[i] is occluded, else 0, for rays that Embree accepts. Converts to Embree's rays on the way, as
  /// any host has to.
  void occluded(RaySpan rays, Mode mode, std::uint8_t* out) const;

  /// What rtcCommitScene took of build: wall time, and processor time of the calling thread.
  double commit_seconds() const;
  double commit_thread_seconds() const;

  /// What Embree's memory monitor counted: after the build, and at most during it; vertices and indices included.
  std::size_t bytes() const;
  std::size_t peak_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace umbrix::embree
