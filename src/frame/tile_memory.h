// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "frame/occlusion_memory.h"
#include "kernels/group_rays.h"
#include "umbrix/frame.h"

namespace umbrix::detail {

/// Where a ray belongs: a light, and a region of the image or a cell of space.
struct Place {
  std::uint32_t light = 0;
  std::int32_t x = 0, y = 0, z = 0;

  friend bool operator==(const Place& a, const Place& b) noexcept {
    return a.light == b.light && a.x == b.x && a.y == b.y && a.z == b.z;
  }
  /// Steele, Lea & Flood 2014, "Fast splittable pseudorandom number generators": the finaliser, on a sum of multiples.
  std::uint64_t key() const noexcept {
    std::uint64_t h = light * 0x9E3779B97F4A7C15u + static_cast<std::uint32_t>(x) * 0xC2B2AE3D27D4EB4Fu +
                      static_cast<std::uint32_t>(y) * 0x165667B19E3779F9u +
                      static_cast<std::uint32_t>(z) * 0xD6E8FEB86659FD93u;
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9u;
    return h ^ (h >> 27);
  }
};

/// Tells where rays belong.
class PlaceFinder {
 public:
  PlaceFinder(const FrameOptions& options, std::int64_t frame, double extent)
      : options_(options),
        frame_(static_cast<std::uint64_t>(frame)),
        inverse_cell_(static_cast<float>(1 / (extent * static_cast<double>(options.cell)))) {}

  std::uint32_t together() const noexcept { return options_.region; }
  PredictorRule rule() const noexcept { return options_.rule; }
  bool needs_pixels() const noexcept { return options_.key == PredictorKey::screen; }

  Place find(std::uint32_t light, const Ray& ray, const Pixel* pixel) const noexcept {
    if (needs_pixels()) {
      const std::uint32_t n = options_.region;
      return {light, static_cast<std::int32_t>(pixel->x / n), static_cast<std::int32_t>(pixel->y / n), 0};
    }
    return {light, cell(ray.origin[0]), cell(ray.origin[1]), cell(ray.origin[2])};
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
  /// Cells on both sides of zero are one, and far outside of the scene all are: that costs predictions only.
  std::int32_t cell(float x) const noexcept {
    const float at = x * inverse_cell_;
    return at > -0x1p30f && at < 0x1p30f ? static_cast<std::int32_t>(at) : 0;
  }

  FrameOptions options_;
  std::uint64_t frame_;
  float inverse_cell_;
};

/// What a group knows of its rays from the last frame, and where it puts what it learns. For one tile. Neighbours mostly
/// belong to one place, so the memory is asked and told only where that changes.
class TileMemory {
 public:
  /// `pixels` may be null. With `remembers` false it knows nothing and learns nothing.
  TileMemory(const OcclusionMemory& memory, const PlaceFinder& places, std::uint32_t light, const Pixel* pixels,
             bool remembers)
      : memory_(memory),
        places_(places),
        light_(light),
        pixels_(pixels),
        remembers_(remembers && (pixels || !places.needs_pixels())) {}

  void place(const GroupRays& rays, std::size_t begin, const std::uint16_t* order, std::uint32_t count) noexcept {
    begin_ = begin;
    known_count_ = 0;
    Place place;
    for (std::uint32_t k = 0; k < count && remembers_; ++k) {
      const std::uint16_t i = order[k];
      // Cells are larger than the spacing of rays: a few neighbours go by the first of them.
      if (places_.needs_pixels() || k % places_.together() == 0) {
        const Place here = places_.find(light_, rays.rays[begin + i], pixel(i));
        if (known_count_ == 0 || !(here == place)) {
          place = here;
          recall(place);
        }
      }
      known_of_[i] = static_cast<std::uint16_t>(known_count_ - 1);
    }
  }

  Guess guess(std::uint32_t i) const noexcept { return remembers_ ? known_[known_of_[i]].guess : Guess::unknown; }

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
      // The rays of one place follow each other.
      Known& known = known_[known_of_[order[k]]];
      std::uint32_t rays = 0, occluded = 0;
      for (; k < count && &known_[known_of_[order[k]]] == &known; ++k, ++rays) {
        const std::uint32_t answer = out[begin_ + order[k]];
        occluded += answer;
        if (places_.takes_samples() && places_.is_sample(pixel(order[k]))) ++known.seen[answer];
      }
      known.outcomes[0] += rays - occluded;
      known.outcomes[1] += occluded;
    }
    for (std::uint32_t k = 0; k < known_count_; ++k) {
      const Known& known = known_[k];
      std::uint64_t* const row = known.guess == Guess::occluded     ? confusion_.predicted_occluded
                                 : known.guess == Guess::unoccluded ? confusion_.predicted_unoccluded
                                                                    : confusion_.not_predicted;
      for (const int occluded : {0, 1}) row[occluded] += known.outcomes[occluded];
      const std::uint32_t* const seen = places_.takes_samples() ? known.seen : known.outcomes;
      if (seen[0] + seen[1] > 0) memory_.learn(known.slot, Memory(seen[1], seen[0], known.seen_blocker - 1u));
    }
    known_count_ = 0;
  }

  const Confusion& confusion() const noexcept { return confusion_; }

 private:
  struct Known {
    std::uint32_t slot;
    std::uint32_t blocker;
    Guess guess;
    bool is_sure;
    std::uint32_t outcomes[2];   ///< rays that were not occluded, and that were
    std::uint32_t seen[2];       ///< of these, the samples, by PredictorRule::sample
    std::uint32_t seen_blocker;  ///< plus one
  };
  static constexpr std::uint32_t kTogether = 1;

  void recall(const Place& place) noexcept {
    Known& known = known_[known_count_++];
    known.slot = memory_.slot(place.key());
    const Memory last = memory_.last(known.slot);
    known.guess = detail::guess(last, places_.rule());
    known.is_sure = last.counter() == 3;
    known.blocker = last.blocker();
    known.outcomes[0] = known.outcomes[1] = known.seen[0] = known.seen[1] = known.seen_blocker = 0;
  }

  const Pixel* pixel(std::uint32_t i) const noexcept { return pixels_ ? pixels_ + begin_ + i : nullptr; }

  const OcclusionMemory& memory_;
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
