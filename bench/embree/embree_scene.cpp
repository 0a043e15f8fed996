// SPDX-License-Identifier: Apache-2.0
#include "embree/embree_scene.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <ctime>
#include <limits>
#include <string>

#include "embree/embree_api.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace umbrix::embree {
namespace {

// Embree's manual asks its callers to flush denormals.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
  ~FlushDenormals() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;

 public:
#else
  FlushDenormals() = default;
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
};

RTCRay to_embree(const Ray& ray) {
  RTCRay r;
  r.org_x = ray.origin[0];
  r.org_y = ray.origin[1];
  r.org_z = ray.origin[2];
  r.tnear = ray.tmin;
  r.dir_x = ray.direction[0];
  r.dir_y = ray.direction[1];
  r.dir_z = ray.direction[2];
  r.time = 0;
  r.tfar = ray.tmax;
  r.mask = 0xFFFFFFFFu;
  r.id = 0;
  r.flags = 0;
  return r;
}

// Embree marks an occluded ray with tfar = -inf; a ray that came with it was not occluded.
std::uint8_t is_occluded(float tfar_after, float tmax) {
  constexpr float kMark = -std::numeric_limits<float>::infinity();
  return tfar_after == kMark && tmax != kMark ? 1 : 0;
}

void occluded_single(Query& query, RaySpan rays, std::uint8_t* out) {
  for (std::size_t i = 0; i < rays.count; ++i) {
    RTCRay ray = to_embree(rays[i]);
    query.occluded(ray);
    out[i] = is_occluded(ray.tfar, rays[i].tmax);
  }
}

template <typename Packet, std::size_t kWidth>
void occluded_packets(Query& query, RaySpan rays, std::uint8_t* out) {
  for (std::size_t begin = 0; begin < rays.count; begin += kWidth) {
    const std::size_t count = std::min(kWidth, rays.count - begin);
    alignas(64) int valid[kWidth];
    Packet packet;
    for (std::size_t i = 0; i < kWidth; ++i) {
      const Ray& ray = rays[begin + std::min(i, count - 1)];
      valid[i] = i < count ? -1 : 0;
      packet.org_x[i] = ray.origin[0];
      packet.org_y[i] = ray.origin[1];
      packet.org_z[i] = ray.origin[2];
      packet.tnear[i] = ray.tmin;
      packet.dir_x[i] = ray.direction[0];
      packet.dir_y[i] = ray.direction[1];
      packet.dir_z[i] = ray.direction[2];
      packet.time[i] = 0;
      packet.tfar[i] = ray.tmax;
      packet.mask[i] = 0xFFFFFFFFu;
      packet.id[i] = 0;
      packet.flags[i] = 0;
    }
    query.occluded(valid, packet);
    for (std::size_t i = 0; i < count; ++i) out[begin + i] = is_occluded(packet.tfar[i], rays[begin + i].tmax);
  }
}

#if UMBRIX_EMBREE_MAJOR < 4
void occluded_stream(Query& query, RaySpan rays, std::uint8_t* out) {
  constexpr std::size_t kBatch = 256;  // 12 KiB: stays in the first-level cache
  std::array<RTCRay, kBatch> batch;
  for (std::size_t begin = 0; begin < rays.count; begin += kBatch) {
    const std::size_t count = std::min(kBatch, rays.count - begin);
    for (std::size_t i = 0; i < count; ++i) batch[i] = to_embree(rays[begin + i]);
    query.occluded_stream(batch.data(), static_cast<unsigned>(count));
    for (std::size_t i = 0; i < count; ++i) out[begin + i] = is_occluded(batch[i].tfar, rays[begin + i].tmax);
  }
}
#endif

double seconds_on(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Status no_memory() { return {StatusCode::resource_limit, "Embree: no memory for the geometry"}; }

// Copies a mesh into buffers of Embree's own.
Status attach(RTCDevice device, RTCScene scene, const MeshView& mesh, RTCBuildQuality quality) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertex_count));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangle_count));
  if (vertices == nullptr || indices == nullptr) {
    rtcReleaseGeometry(geometry);
    return no_memory();
  }
  for (std::size_t i = 0; i < mesh.vertex_count; ++i) {
    std::memcpy(vertices + 3 * i, reinterpret_cast<const char*>(mesh.vertices) + i * mesh.vertex_stride,
                3 * sizeof(float));
  }
  for (std::size_t i = 0; i < mesh.triangle_count; ++i) {
    if (mesh.indices != nullptr) {
      std::memcpy(indices + 3 * i, reinterpret_cast<const char*>(mesh.indices) + i * mesh.index_stride,
                  3 * sizeof(std::uint32_t));
    } else {
      for (std::size_t k = 0; k < 3; ++k) indices[3 * i + k] = static_cast<std::uint32_t>(3 * i + k);
    }
  }
  rtcSetGeometryBuildQuality(geometry, quality);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  return {};
}

}  // namespace

struct EmbreeScene::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::atomic<std::ptrdiff_t> bytes{0};
  std::atomic<std::ptrdiff_t> peak{0};
  double commit_seconds = 0;
  double commit_thread_seconds = 0;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  static bool count_bytes(void* user, ssize_t change, bool /*post*/) {
    auto& self = *static_cast<Impl*>(user);
    const std::ptrdiff_t now = self.bytes += change;
    std::ptrdiff_t peak = self.peak;
    while (now > peak && !self.peak.compare_exchange_weak(peak, now)) {
    }
    return true;
  }
};

const std::vector<Mode>& modes() {
#if UMBRIX_EMBREE_MAJOR >= 4
  static const std::vector<Mode> all = {Mode::single, Mode::packet8, Mode::packet16, Mode::packet16_coherent};
#else
  static const std::vector<Mode> all = {Mode::single,          Mode::packet8,
                                        Mode::packet16,        Mode::packet16_coherent,
                                        Mode::stream_coherent, Mode::stream_incoherent};
#endif
  return all;
}

const char* mode_name(Mode mode) {
  switch (mode) {
    case Mode::single:
      return "single";
    case Mode::packet8:
      return "8";
    case Mode::packet16:
      return "16";
    case Mode::packet16_coherent:
      return "16-coherent";
    case Mode::stream_coherent:
      return "stream-coherent";
    case Mode::stream_incoherent:
      return "stream-incoherent";
  }
  return "";
}

const char* version() { return RTC_VERSION_STRING; }

bool accepts(const Ray& ray) {
  constexpr float kLargest = 1.844e18f;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(std::abs(ray.origin[k]) <= kLargest && std::abs(ray.direction[k]) <= kLargest)) return false;
  }
  return ray.tmin >= 0 && !std::isnan(ray.tmax);
}

EmbreeScene::EmbreeScene() noexcept = default;
EmbreeScene::~EmbreeScene() = default;
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;

Status EmbreeScene::build(const std::vector<MeshView>& meshes, const Options& options) {
  const FlushDenormals mode;
  auto impl = std::make_unique<Impl>();
  std::string config = "set_affinity=0";
  if (options.threads > 0) config += ",threads=" + std::to_string(options.threads);
  impl->device = rtcNewDevice(config.c_str());
  if (impl->device == nullptr) return {StatusCode::internal, "Embree: no device"};
  rtcSetDeviceMemoryMonitorFunction(impl->device, &Impl::count_bytes, impl.get());
  impl->scene = rtcNewScene(impl->device);
  const RTCBuildQuality quality = options.quality == Quality::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
  rtcSetSceneBuildQuality(impl->scene, quality);
  rtcSetSceneFlags(impl->scene, options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  for (const MeshView& mesh : meshes) {
    if (mesh.triangle_count == 0) continue;
    if (Status status = attach(impl->device, impl->scene, mesh, quality); !status) return status;
  }
  const double wall = seconds_on(CLOCK_MONOTONIC), thread = seconds_on(CLOCK_THREAD_CPUTIME_ID);
  rtcCommitScene(impl->scene);
  impl->commit_seconds = seconds_on(CLOCK_MONOTONIC) - wall;
  impl->commit_thread_seconds = seconds_on(CLOCK_THREAD_CPUTIME_ID) - thread;
  if (rtcGetDeviceError(impl->device) != RTC_ERROR_NONE) return {StatusCode::internal, "Embree: the build failed"};
  impl_ = std::move(impl);
  return {};
}

void EmbreeScene::occluded(RaySpan rays, Mode mode, std::uint8_t* out) const {
  const FlushDenormals flush;
  Query query(impl_->scene, mode == Mode::packet16_coherent || mode == Mode::stream_coherent);
  switch (mode) {
    case Mode::single:
      return occluded_single(query, rays, out);
    case Mode::packet8:
      return occluded_packets<RTCRay8, 8>(query, rays, out);
    case Mode::packet16:
    case Mode::packet16_coherent:
      return occluded_packets<RTCRay16, 16>(query, rays, out);
    case Mode::stream_coherent:
    case Mode::stream_incoherent:
#if UMBRIX_EMBREE_MAJOR < 4
      return occluded_stream(query, rays, out);
#else
      return;  // not among modes()
#endif
  }
}

double EmbreeScene::commit_seconds() const { return impl_->commit_seconds; }
double EmbreeScene::commit_thread_seconds() const { return impl_->commit_thread_seconds; }
std::size_t EmbreeScene::bytes() const { return static_cast<std::size_t>(impl_->bytes.load()); }
std::size_t EmbreeScene::peak_bytes() const { return static_cast<std::size_t>(impl_->peak.load()); }

}  // namespace umbrix::embree
