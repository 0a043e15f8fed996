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

  PredictorRule rule() const noexcept { return options_.rule; }
  bool needs_pixels() const noexcept { return options_.key == PredictorKey::screen; }

  Place find(std::uint32_t light, const Ray& ray, const Pixel* pixel) const noexcept {
    if (needs_pixels()) {
      const std::uint32_t n = options_.region;
      return {light, static_cast<std::int32_t>(pixel->x / n), static_cast<std::int32_t>(pixel->y / n), 0};
    }
    return {light, cell(ray.origin[0]), cell(ray.origin[1]), cell(ray.origin[2])};
  }

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
    store();
    begin_ = begin;
    known_count_ = 0;
    Place place;
    for (std::uint32_t k = 0; k < count && remembers_; ++k) {
      const std::uint16_t i = order[k];
      const Place here = places_.find(light_, rays.rays[begin + i], pixel(i));
      if (known_count_ == 0 || !(here == place)) {
        place = here;
        Known& known = known_[known_count_++];
        known.slot = memory_.slot(place.key());
        const Memory last = memory_.last(known.slot);
        known.guess = detail::guess(last, places_.rule());
        known.is_sure = last.counter() == 3;
        known.blocker = last.blocker();
        known.seen = Memory();
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

  void learn(std::uint32_t i, bool occluded, std::uint32_t blocker) noexcept {
    const Guess guessed = guess(i);
    std::uint64_t* const row = guessed == Guess::occluded     ? confusion_.predicted_occluded
                               : guessed == Guess::unoccluded ? confusion_.predicted_unoccluded
                                                              : confusion_.not_predicted;
    ++row[occluded ? 1 : 0];
    if (!remembers_ || !places_.is_sample(pixel(i))) return;
    Known& known = known_[known_of_[i]];
    known.seen = known.seen.merged(Memory::of_ray(occluded, blocker));
  }

  /// Hands over what was learned and is still held back.
  void store() noexcept {
    for (std::uint32_t k = 0; k < known_count_; ++k)
      if (!known_[k].seen.empty()) memory_.learn(known_[k].slot, known_[k].seen);
    known_count_ = 0;
  }

  const Confusion& confusion() const noexcept { return confusion_; }

 private:
  struct Known {
    std::uint32_t slot;
    std::uint32_t blocker;
    Guess guess;
    bool is_sure;
    Memory seen;
  };

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
