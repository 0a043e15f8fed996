// SPDX-License-Identifier: Apache-2.0
#if defined(UMBRIX_KERNELS_GROUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_GROUP_INL_H_
#undef UMBRIX_KERNELS_GROUP_INL_H_
#else
#define UMBRIX_KERNELS_GROUP_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdlib>
#include <cstdio>

#include "kernels/beam-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

inline int knob(const char* name, int def) { const char* v = std::getenv(name); return v ? std::atoi(v) : def; }

template <class Counts>
struct Learn : Counts {
  const Block* block = nullptr;
  std::uint32_t lane = 0;
  bool blocked_by(const Block& b, std::uint32_t l) noexcept { block = &b; lane = l; return true; }
};
/// Answers up to kMost rays together.
template <class Counts>
class Group {
 public:
  static constexpr std::uint32_t kMost = 256;

  Group(const SceneView& scene, const QueryOptions& options) : scene_(scene), tree_(*static_cast<const WideTree*>(scene.side)), filter_(scene, options), skip_(options.skip) {
    cached_.count = 0;
    cached_.edge_bound = 0;
  }

  void trace(RaySpan rays, std::size_t begin, std::uint32_t count, std::uint8_t* out, Counts* each) {
    std::uint32_t active = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Ray& ray = rays[begin + i];
      out[i] = 0;
      if (HWY_UNLIKELY(!is_valid(ray))) {
        each[i].invalid_ray();
        continue;
      }
      Segment& segment = segments_[i];
      if (HWY_UNLIKELY(prepare(ray, *scene_.tree, segment.ray) == Reach::far)) {
        if (skip_) filter_.set_skip(skip_[begin + i]);
        out[i] = far_occluded(scene_, filter_, ray, each[i]);
        continue;
      }
      segment.within = clip_to_root(segment.ray, scene_.tree->root);
      if (segment.within.t0 <= segment.within.t1) order_[active++] = static_cast<std::uint16_t>(i);
    }
    rays_ = rays;
    begin_ = begin;
    out_ = out;
    each_ = each;
    if (active > 0) split(0, active);
  }

 private:
  void split(std::uint32_t first, std::uint32_t count) {
    static const int min_rays = knob("BEAM_MINRAYS", 8);
    static const std::uint32_t most = (std::uint32_t)knob("BEAM_MOST", 256);
    const Beam beam(segments_, order_ + first, count, *scene_.tree);
    static const float ratio = (float)knob("BEAM_RATIO", 75) * 0.01f;
    static const std::uint32_t pre = (std::uint32_t)knob("BEAM_PRE", 32);
    static long walks = 0, nodes = 0, leaves = 0, fails = 0, rays = 0; 
    if (count >= pre && ratio > 0) {
      const std::uint32_t cut = cut_at(beam, first, count);
      const Beam a(segments_, order_ + first, cut, *scene_.tree), b(segments_, order_ + first + cut, count - cut, *scene_.tree);
      if (a.size() + b.size() < ratio * beam.size()) {
      split(first, cut);
      split(first + cut, count - cut);
      return;
      }
    }
    LeafSpan span;
    Counts shared;
    if (!beam.gather(tree_, list_, span, most, shared)) { ++fails;
      if (count <= (std::uint32_t)min_rays) {
        for (std::uint32_t i = first; i < first + count; ++i) alone(order_[i]);
        return;
      }
      const std::uint32_t cut = cut_at(beam, first, count);
      split(first, cut);
      split(first + cut, count - cut);
      return;
    }
    if constexpr (!std::is_same_v<Counts, NoCounts>) { walks++; nodes += shared.counts.node_tests; leaves += shared.counts.leaf_visits; rays += count;
     if (walks % 1000 == 0) fprintf(stderr, "walks %ld nodes %.1f leaves %.1f fails %ld rays/walk %.1f\n", walks, double(nodes)/walks, double(leaves)/walks, fails, double(rays)/walks); }
    charge(shared, first, count);
    refine(beam, span, first, count);
  }

  void refine(const Beam& beam, LeafSpan span, std::uint32_t first, std::uint32_t count) {
    static const std::uint32_t short_list = (std::uint32_t)knob("BEAM_SHORT", 8);
    static const std::uint32_t min_split = (std::uint32_t)knob("BEAM_MINSPLIT", 16);
    if (span.count == 0) return;
    if (span.count <= short_list || count <= min_split || span.end() + span.count + 8 > LeafList::kRoom) {
      for (std::uint32_t i = first; i < first + count; ++i) one(order_[i], span);
      return;
    }
    const std::uint32_t cut = cut_at(beam, first, count);
    for (int half = 0; half < 2; ++half) {
      const std::uint32_t f = half ? first + cut : first, n = half ? count - cut : cut;
      const Beam part(segments_, order_ + f, n, *scene_.tree);
      refine(part, part.pick(list_, span), f, n);
    }
  }

  void charge(const Counts& shared, std::uint32_t first, std::uint32_t count) {
    if constexpr (!std::is_same_v<Counts, NoCounts>) {
      for (std::uint32_t i = 0; i < count; ++i)
        each_[order_[first + i]].counts.node_tests += shared.counts.node_tests / count + (i < shared.counts.node_tests % count);
    }
  }

  std::uint32_t cut_at(const Beam& beam, std::uint32_t first, std::uint32_t count) {
    const Vec3 e = beam.starts().extent();
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    const float middle = 0.5f * (beam.starts().lower[axis] + beam.starts().upper[axis]);
    std::uint16_t high[kMost];
    std::uint32_t lows = 0, highs = 0;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Segment& s = segments_[order_[i]];
      if (s.ray.origin[axis] + s.ray.direction[axis] * s.within.t0 < middle) order_[first + lows++] = order_[i];
      else high[highs++] = order_[i];
    }
    std::copy(high, high + highs, order_ + first + lows);
    return lows == 0 || highs == 0 ? count / 2 : lows;
  }

  void remember(const Block& b, std::uint32_t lane) {
    static const std::uint32_t K = (std::uint32_t)knob("BEAM_K", 4);
    if (&b == &cached_) return;
    std::uint32_t at = next_++ % K;
    if (cached_.count < K) at = cached_.count++;
    for (int k = 0; k < 3; ++k) { cached_.v0[k][at] = b.v0[k][lane]; cached_.e1[k][at] = b.e1[k][lane]; cached_.e2[k][at] = b.e2[k][lane]; }
    cached_.id[at] = b.id[lane];
    cached_.edge_bound = std::max(cached_.edge_bound, b.edge_bound);
  }
  template <class F> void answer(std::uint32_t i, F&& f) {
    const Ray& ray = rays_[begin_ + i];
    if (skip_) filter_.set_skip(skip_[begin_ + i]);
    const Segment& s = segments_[i];
    const LeafTest test(s.ray);
    Learn<Counts> learn;
    bool occ = false;
    static const bool on = knob("BEAM_CACHE", 1);
    if (on && last_ && cached_.count > 0) {
      const float reach = 30 + cached_.edge_bound;
      learn.indexed(cached_.count);
      occ = block_blocks(scene_, filter_, ray, test, s.ray, cached_, reach, learn);
      hits += occ;
      tries++;
    }
    if (!occ) occ = f(ray, s, test, learn);
    if (occ && learn.block) remember(*learn.block, learn.lane);
    add(each_[i], learn);
    last_ = occ;
    out_[i] = occ;
  }
  static void add(NoCounts&, const NoCounts&) {}
  static void add(CountEach& a, const CountEach& b) { const auto r = a.counts.rays; a.counts += b.counts; a.counts.rays = r; }
  void alone(std::uint32_t i) {
    answer(i, [&](const Ray& ray, const Segment& s, const LeafTest& test, auto& learn) { return wide_walk(tree_, s.within, s.ray,
        [&](BlockRun run, float, float t1) { return leaf_blocks(scene_, filter_, ray, test, s.ray, run, t1, learn); }, learn); });
  }

  void one(std::uint32_t i, LeafSpan span) {
    answer(i, [&](const Ray& ray, const Segment& s, const LeafTest& test, auto& learn) { return visit_crossed(list_, span, s,
        [&](BlockRun run, float, float t1) { return leaf_blocks(scene_, filter_, ray, test, s.ray, run, t1, learn); }, learn); });
  }
  public: long hits = 0, tries = 0; private:
  bool last_ = false; std::uint32_t next_ = 0;

  const SceneView& scene_;
  const WideTree& tree_;
  Filter filter_;
  const Primitive* skip_;
  RaySpan rays_;
  std::size_t begin_ = 0;
  std::uint8_t* out_ = nullptr;
  Counts* each_ = nullptr;
  Block cached_;
  std::uint16_t order_[kMost];
  Segment segments_[kMost];
  LeafList list_;
};

inline void group_occluded(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options) {
  static const std::size_t run = (std::size_t)knob("BEAM_RUN", 256);
  Group<NoCounts> group(scene, options);
  static NoCounts none[256];
  for (std::size_t i = 0; i < rays.count; i += run) group.trace(rays, i, (std::uint32_t)std::min<std::size_t>(run, rays.count - i), out + i, none);
}
inline void group_occluded_counted(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options, OcclusionCounts& counts) {
  static const std::size_t run = (std::size_t)knob("BEAM_RUN", 256);
  Group<CountEach> group(scene, options);
  for (std::size_t i = 0; i < rays.count; i += run) {
    CountEach each[256];
    const auto n = (std::uint32_t)std::min<std::size_t>(run, rays.count - i);
    group.trace(rays, i, n, out + i, each);
    for (std::uint32_t k = 0; k < n; ++k) (out[i + k] ? counts.occluded : counts.unoccluded) += each[k].counts;
  }
}
inline const EntryPoints& group_entry_points() {
  static const EntryPoints e = {&group_occluded, &group_occluded_counted, entry_points<TreeKernel<StackWalk>>().closest, entry_points<TreeKernel<StackWalk>>().closest_counted};
  return e;
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
