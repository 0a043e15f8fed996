// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "core/lazy_array.h"
#include "kernels/group_rays.h"
#include "umbrix/frame.h"

namespace umbrix::detail {

/// What one place remembers, in 64 bits: how many of a frame's rays were occluded and how many not, the triangle with
/// the highest number that blocked one, and a two-bit counter as it stood before the frame. Merging is commutative, so
/// what is remembered does not depend on the order of tiles.
class Memory {
 public:
  explicit Memory(std::uint64_t bits = 0) noexcept : bits_(bits) {}
  Memory(std::uint32_t occluded, std::uint32_t unoccluded, std::uint32_t blocker) noexcept
      : bits_((std::uint64_t{std::min(occluded, kVotes)} << kOccluded) |
              (std::uint64_t{std::min(unoccluded, kVotes)} << kUnoccluded) | (blocker + 1u)) {}  // kNone becomes 0

  std::uint64_t bits() const noexcept { return bits_; }
  bool empty() const noexcept { return bits_ == 0; }
  std::uint32_t occluded() const noexcept { return field(kOccluded, kVotes); }
  std::uint32_t unoccluded() const noexcept { return field(kUnoccluded, kVotes); }
  /// A triangle of the scene's list, or Primitive::kNone.
  std::uint32_t blocker() const noexcept { return static_cast<std::uint32_t>(bits_) - 1u; }

  Memory merged(Memory o) const noexcept {
    Memory m;
    const auto sum = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a + b, kVotes)}; };
    m.bits_ = std::max(bits_ & kBlocker, o.bits_ & kBlocker) | (sum(occluded(), o.occluded()) << kOccluded) |
              (sum(unoccluded(), o.unoccluded()) << kUnoccluded) |
              std::max(bits_ & kCounterBits, o.bits_ & kCounterBits);
    return m;
  }

  /// The counter after this frame's majority moved it: 0 and 1 say unoccluded, 2 and 3 occluded; 4: nothing is known.
  std::uint32_t counter() const noexcept {
    const std::uint32_t before = field(kCounter, 7);
    const int votes = static_cast<int>(occluded()) - static_cast<int>(unoccluded());
    if (before == 0) return votes == 0 ? 4 : votes > 0 ? (unoccluded() == 0 ? 3 : 2) : (occluded() == 0 ? 0 : 1);
    const int moved = static_cast<int>(before) - 1 + (votes > 0 ? 1 : votes < 0 ? -1 : 0);
    return static_cast<std::uint32_t>(std::clamp(moved, 0, 3));
  }
  Memory with_counter(std::uint32_t counter) const noexcept {
    return Memory((bits_ & ~kCounterBits) | (counter < 4 ? std::uint64_t{counter + 1} << kCounter : 0));
  }

 private:
  static constexpr int kOccluded = 32, kUnoccluded = 46, kCounter = 60;
  static constexpr std::uint32_t kVotes = (1u << 14) - 1;
  static constexpr std::uint64_t kBlocker = 0xFFFFFFFFu;
  static constexpr std::uint64_t kCounterBits = std::uint64_t{7} << kCounter;

  std::uint32_t field(int at, std::uint32_t mask) const noexcept {
    return static_cast<std::uint32_t>(bits_ >> at) & mask;
  }

  std::uint64_t bits_;
};

/// Two tables of memories by slot: one that the last frame filled, to read, and one that this frame fills. Any number
/// of threads.
class OcclusionMemory {
 public:
  /// `slots` is a power of two. Throws std::bad_alloc.
  explicit OcclusionMemory(std::uint32_t slots) : mask_(slots - 1), tables_{Table(slots), Table(slots)} {}

  /// The slot of a place given by three coordinates and a light. Two by two by two neighbours share a line of the
  /// cache.
  std::uint32_t slot(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t light) const noexcept {
    // Steele, Lea & Flood 2014, "Fast splittable pseudorandom number generators": the finaliser, on a sum of multiples.
    const auto part = [](std::int32_t i) { return std::uint64_t{static_cast<std::uint32_t>(i >> 1)}; };
    std::uint64_t h = part(x) * 0x9E3779B97F4A7C15u + part(y) * 0xC2B2AE3D27D4EB4Fu + part(z) * 0x165667B19E3779F9u +
                      light * 0xD6E8FEB86659FD93u;
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9u;
    const auto line = static_cast<std::uint32_t>((h ^ (h >> 27)) >> 16);
    return (line << 3 | static_cast<std::uint32_t>((x & 1) << 2 | (y & 1) << 1 | (z & 1))) & mask_;
  }

  Memory last(std::uint32_t slot) const noexcept {
    return Memory(tables_[1 - now_][slot].load(std::memory_order_relaxed));
  }

  /// Asks for a slot's memory, of the last frame and of this one, before it is wanted.
  void prefetch(std::uint32_t slot) const noexcept {
    for (const Table& table : tables_) __builtin_prefetch(&table[slot]);
  }

  void learn(std::uint32_t slot, Memory seen) const noexcept {
    std::atomic<std::uint64_t>& entry = tables_[now_][slot];
    std::uint64_t before = entry.load(std::memory_order_relaxed);
    for (;;) {
      const Memory base = before == 0 ? Memory().with_counter(last(slot).counter()) : Memory(before);
      const std::uint64_t after = base.merged(seen).bits();
      if (after == before || entry.compare_exchange_weak(before, after, std::memory_order_relaxed)) return;
    }
  }

  /// Makes what was learned what is read. Not while others use it.
  void next_frame() noexcept {
    now_ = 1 - now_;
    clear(tables_[now_]);
  }
  void forget() noexcept {
    for (Table& table : tables_) clear(table);
  }

  std::uint64_t bytes() const noexcept { return 2 * sizeof(std::uint64_t) * (std::uint64_t{mask_} + 1); }

 private:
  using Table = LazyArray<std::atomic<std::uint64_t>>;

  void clear(Table& table) noexcept {
    for (std::size_t i = 0; i < table.size(); ++i) table[i].store(0, std::memory_order_relaxed);
  }

  std::uint32_t mask_;
  std::uint32_t now_ = 0;
  Table tables_[2];
};

/// What is guessed from a memory by a rule.
inline Guess guess(Memory memory, PredictorRule rule) noexcept {
  if (rule == PredictorRule::counter) {
    const std::uint32_t counter = memory.counter();
    return counter > 3 ? Guess::unknown : counter >= 2 ? Guess::occluded : Guess::unoccluded;
  }
  const std::uint32_t occluded = memory.occluded(), unoccluded = memory.unoccluded();
  if (occluded == unoccluded) return Guess::unknown;
  return occluded > unoccluded ? Guess::occluded : Guess::unoccluded;
}

}  // namespace umbrix::detail
