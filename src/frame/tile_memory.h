// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "frame/occlusion_memory.h"
#include "kernels/group_rays.h"
#include "umbrix/frame.h"

namespace umbrix::detail {

/// Where a ray belongs: a cell of space, or a region of the image in x and y.
struct Place {
  std::int32_t x = 0, y = 0, z = 0;

  friend bool operator==(const Place& a, const Place& b) noexcept { return a.x == b.x && a.y == b.y && a.z == b.z; }
};

/// Tells where rays belong.
class PlaceFinder {
 public:
  PlaceFinder(const FrameOptions& options, std::int64_t frame, double cell_size)
      : options_(options),
        frame_(static_cast<std::uint64_t>(frame)),
        inverse_cell_(static_cast<float>(1 / cell_size)) {}

  PredictorRule rule() const noexcept { return options_.rule; }
  bool needs_pixels() const noexcept { return options_.key == PredictorKey::screen; }

  Place find(const Ray& ray, const Pixel* pixel) const noexcept {
    if (needs_pixels()) {
      const std::uint32_t n = options_.region;
      const std::uint32_t x = pixel->x / n, y = pixel->y / n;  // two by four share a line of the cache
      return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y / 2), static_cast<std::int32_t>(y % 2)};
    }
    return {cell(ray.origin[0]), cell(ray.origin[1]), cell(ray.origin[2])};
  }

  bool takes_samples() const noexcept { return options_.rule == PredictorRule::sample; }

  /// Does this ray's outcome count? By PredictorRule::sample one pixel of each region does, another in each frame.
  bool is_sample(const Pixel* pixel) const noexcept {
    if (options_.rule != PredictorRule::sample || !pixel) return true;
    const std::uint32_t n = options_.region;
    const std::uint64_t turn = (frame_ * 0x9E3779B97F4A7C15u) >> 32;
    return pixel->x % n == turn % n && pixel->y % n == (turn / n) % n;
  }

 private:
  /// Cells on both sides of zero are one, and those far outside of the scene too: that costs predictions only.
  std::int32_t cell(float x) const noexcept {
    return static_cast<std::int32_t>(std::min(std::max(-0x1p30f, x * inverse_cell_), 0x1p30f));  // NaN: the first
  }

  FrameOptions options_;
  std::uint64_t frame_;
  float inverse_cell_;
};

/// Which memory a frame's rays use, and how.
struct MemoryUse {
  const OcclusionMemory* memory = nullptr;  ///< null: nothing is known, nothing is learned
  const OcclusionMemory* also = nullptr;    ///< learns too, with `also_coarser`
  std::uint32_t together = 1;               ///< so many rays, one after the other, go by the place of the first
  std::uint32_t coarser = 0;                ///< places are larger by two to this power
  std::uint32_t also_coarser = 0;
  bool only_occluded = false;  ///< where every ray has its own place, only those that are blocked are worth the room
};

/// What a group knows of its rays from the last frame, and where it puts what it learns. For one tile. Neighbours
/// mostly belong to one place, so the memory is asked and told only where that changes.
class TileMemory {
 public:
  /// `pixels` may be null.
  TileMemory(const MemoryUse& use, const PlaceFinder& places, std::uint32_t light, const Pixel* pixels)
      : use_(use),
        places_(places),
        light_(light),
        pixels_(pixels),
        remembers_(use.memory && (pixels || !places.needs_pixels())) {}

  void place(const GroupRays& rays, std::size_t begin, const std::uint16_t* order, std::uint32_t count) noexcept {
    begin_ = begin;
    known_count_ = 0;
    if (!remembers_) return;
    for (std::uint32_t k = 0; k < count;) {
      const Place here = places_.find(rays.rays[begin + order[k]], pixel(order[k]));
      if (known_count_ == 0 || !(here == known_[known_count_ - 1].place)) begin_place(here);
      const auto known = static_cast<std::uint16_t>(known_count_ - 1);
      for (const std::uint32_t end = std::min(count, k + use_.together); k < end; ++k) known_of_[order[k]] = known;
    }
    // The memory is large and its parts are far from each other: all were asked for before the first is looked at.
    for (std::uint32_t k = 0; k < known_count_; ++k) recall(known_[k]);
  }

  Guess guess(std::uint32_t i) const noexcept { return remembers_ ? known_[known_of_[i]].guess : Guess::unknown; }

  /// Is what is known of each ray by itself, or of those around it as well?
  bool is_by_ray() const noexcept { return use_.only_occluded; }

  /// What blocked most rays there, where all were blocked; else Primitive::kNone.
  std::uint32_t sure_blocker(std::uint32_t i) const noexcept {
    return remembers_ && known_[known_of_[i]].is_sure ? known_[known_of_[i]].blocker : Primitive::kNone;
  }
  std::uint32_t blocker(std::uint32_t i) const noexcept {
    return remembers_ ? known_[known_of_[i]].blocker : Primitive::kNone;
  }

  /// Hears of a triangle that blocked a ray.
  void note_blocker(std::uint32_t i, std::uint32_t blocker) noexcept {
    if (!remembers_ || !places_.is_sample(pixel(i))) return;
    Known& known = known_[known_of_[i]];
    known.seen_blocker = std::max(known.seen_blocker, blocker + 1u);  // kNone becomes 0
  }

  /// Learns from the answers to the rays that were placed.
  void learn(const std::uint8_t* out, const std::uint16_t* order, std::uint32_t count) noexcept {
    if (!remembers_) return;
    for (std::uint32_t k = 0; k < count;) {
      Known& known = known_[known_of_[order[k]]];
      const std::uint32_t end = std::min(count, k + use_.together);
      std::uint32_t occluded = 0;
      for (std::uint32_t j = k; j < end; ++j) occluded += out[begin_ + order[j]];
      known.outcomes[0] += end - k - occluded;
      known.outcomes[1] += occluded;
      for (std::uint32_t j = k; j < end && places_.takes_samples(); ++j)
        if (places_.is_sample(pixel(order[j]))) ++known.seen[out[begin_ + order[j]]];
      k = end;
    }
    for (std::uint32_t k = 0; k < known_count_; ++k) {
      const Known& known = known_[k];
      std::uint64_t* const row = known.guess == Guess::occluded     ? confusion_.predicted_occluded
                                 : known.guess == Guess::unoccluded ? confusion_.predicted_unoccluded
                                                                    : confusion_.not_predicted;
      for (const int occluded : {0, 1}) row[occluded] += known.outcomes[occluded];
      const std::uint32_t* const seen = places_.takes_samples() ? known.seen : known.outcomes;
      const Memory memory(seen[1], seen[0], known.seen_blocker - 1u);
      if (seen[1] > 0 || (seen[0] > 0 && !use_.only_occluded)) use_.memory->learn(known.slot, memory);
      if (use_.also && seen[0] + seen[1] > 0)
        use_.also->learn(slot(*use_.also, known.place, use_.also_coarser), memory);
    }
    known_count_ = 0;
  }

  const Confusion& confusion() const noexcept { return confusion_; }

 private:
  struct Known {
    Place place;
    std::uint32_t slot;
    std::uint32_t blocker;
    Guess guess;
    bool is_sure;
    std::uint32_t outcomes[2];   ///< rays that were not occluded, and that were
    std::uint32_t seen[2];       ///< of these, the samples, by PredictorRule::sample
    std::uint32_t seen_blocker;  ///< plus one
  };

  std::uint32_t slot(const OcclusionMemory& memory, const Place& place, std::uint32_t coarser) const noexcept {
    return memory.slot(place.x >> coarser, place.y >> coarser, place.z >> coarser, light_);
  }

  void begin_place(const Place& place) noexcept {
    Known& known = known_[known_count_++];
    known.place = place;
    known.slot = slot(*use_.memory, place, use_.coarser);
    use_.memory->prefetch(known.slot);
  }

  void recall(Known& known) noexcept {
    const Memory last = use_.memory->last(known.slot);
    known.guess = detail::guess(last, places_.rule());
    known.is_sure = last.counter() == 3;
    known.blocker = last.blocker();
    known.outcomes[0] = known.outcomes[1] = known.seen[0] = known.seen[1] = known.seen_blocker = 0;
  }

  const Pixel* pixel(std::uint32_t i) const noexcept { return pixels_ ? pixels_ + begin_ + i : nullptr; }

  const MemoryUse& use_;
  const PlaceFinder& places_;
  std::uint32_t light_;
  const Pixel* pixels_;
  bool remembers_;
  std::size_t begin_ = 0;
  Confusion confusion_;
  std::uint32_t known_count_ = 0;
  Known known_[kMostRays];
  std::uint16_t known_of_[kMostRays];
};

}  // namespace umbrix::detail
