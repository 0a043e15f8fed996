// SPDX-License-Identifier: Apache-2.0
#include "index/bvh_cutter.h"

#include <algorithm>
#include <vector>

#include "core/parallel_for.h"
#include "index/triangle_bvh.h"

namespace umbrix::detail {
namespace {

constexpr std::size_t kMostBins = 16;
constexpr float kInfinity = BvhBounds::kInfinity;

using Int4 = std::int32_t __attribute__((vector_size(16)));

/// Few references say little about many places.
std::size_t bins_for(std::size_t count) { return count < 128 ? kMostBins / 2 : kMostBins; }

float rows_of(std::size_t count) {
  const std::size_t rows = (count + kRowLanes - 1) / kRowLanes;
  return static_cast<float>(rows);
}

/// Where middles are among the bins, on all axes.
class Places {
 public:
  explicit Places(const BvhRange& whole) : origin_(whole.middles.lower) {
    const Float4 extent = whole.middles.extent();
    for (int axis = 0; axis < 3; ++axis) {
      // A little less than the number of bins, so that no rounding leads beyond the last.
      const float scale = static_cast<float>(bins_for(whole.size())) * (1 - 0x1p-20f) / extent[axis];
      scale_[axis] = scale < kInfinity ? scale : 0;
    }
  }
  Int4 operator()(Float4 middle) const { return __builtin_convertvector((middle - origin_) * scale_, Int4); }

 private:
  Float4 origin_, scale_{};
};

struct Bins {
  struct Bin {
    BvhBounds bounds;
    std::size_t count = 0;
  };
  Bin bins[3][kMostBins];

  void add(const Places& places, const BvhReference* begin, const BvhReference* end) {
    for (const BvhReference* r = begin; r != end; ++r) {
      const Int4 place = places(r->middle());
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[axis][place[axis]];
        bin.bounds.extend(r->bounds);
        ++bin.count;
      }
    }
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < kMostBins; ++i) {
        bins[axis][i].bounds.extend(other.bins[axis][i].bounds);
        bins[axis][i].count += other.bins[axis][i].count;
      }
    }
  }
  std::size_t count_below(int axis, std::int32_t bin) const {
    std::size_t count = 0;
    for (std::int32_t i = 0; i < bin; ++i) count += bins[axis][i].count;
    return count;
  }
};

/// Middles in bins below `bin` go to the low side.
struct Cut {
  float cost = kInfinity;
  int axis = 0;
  std::int32_t bin = 0;

  bool is_low(Int4 place) const { return place[axis] < bin; }
};

void compare(const Bins::Bin* bins, std::size_t count, int axis, Cut& best) {
  float high_cost[kMostBins];
  BvhBounds bounds;
  std::size_t references = 0;
  for (std::size_t bin = count - 1; bin > 0; --bin) {
    bounds.extend(bins[bin].bounds);
    references += bins[bin].count;
    high_cost[bin] = references == 0 ? kInfinity : bounds.area() * rows_of(references);
  }
  bounds = BvhBounds();
  references = 0;
  for (std::size_t bin = 1; bin < count; ++bin) {
    bounds.extend(bins[bin - 1].bounds);
    references += bins[bin - 1].count;
    if (references == 0) continue;
    const float cost = bounds.area() * rows_of(references) + high_cost[bin];
    if (cost < best.cost) best = {cost, axis, static_cast<std::int32_t>(bin)};
  }
}

Cut best_cut(const Bins& bins, std::size_t size) {
  Cut best;
  for (int axis = 0; axis < 3; ++axis) compare(bins.bins[axis], bins_for(size), axis, best);
  return best;
}

/// The bounds of both sides; where they part is set.
void bound(const BvhRange& whole, const Bins& bins, const Cut& cut, std::size_t at, BvhRange& low, BvhRange& high) {
  low = high = BvhRange();
  low.first = whole.first;
  low.last = high.first = at;
  high.last = whole.last;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(bins_for(whole.size())); ++i)
    (i < cut.bin ? low : high).bounds.extend(bins.bins[cut.axis][i].bounds);
}

/// Adds a middle to one of two sides, without a branch that could not be foretold.
void add_middle(Float4 middle, bool is_low, BvhRange& low, BvhRange& high) {
  const Int4 mask = is_low ? Int4{-1, -1, -1, -1} : Int4{};
  const Float4 far{kInfinity, kInfinity, kInfinity, kInfinity};
  low.middles.lower = least(low.middles.lower, mask ? middle : far);
  low.middles.minus_upper = least(low.middles.minus_upper, mask ? -middle : far);
  high.middles.lower = least(high.middles.lower, mask ? far : middle);
  high.middles.minus_upper = least(high.middles.minus_upper, mask ? far : -middle);
}

}  // namespace

BvhRange BvhCutter::range(std::size_t first, std::size_t last) const {
  BvhRange result;
  result.first = first;
  result.last = last;
  for (std::size_t i = first; i < last; ++i) {
    result.bounds.extend(references_[i].bounds);
    result.add_middle(references_[i].middle());
  }
  return result;
}

void BvhCutter::halve(const BvhRange& whole, BvhRange& low, BvhRange& high) const {
  const std::size_t first = whole.first, last = whole.last, at = first + whole.size() / 2;
  low = range(first, at);
  high = range(at, last);
}

void BvhCutter::cut(const BvhRange& whole, BvhRange& low, BvhRange& high) const {
  const Places places(whole);
  Bins bins;
  BvhReference* const begin = references_ + whole.first;
  BvhReference* const end = references_ + whole.last;
  bins.add(places, begin, end);
  const Cut best = best_cut(bins, whole.size());
  if (best.bin == 0) return halve(whole, low, high);  // middles that are all the same, or nearly
  const BvhRange cut = whole;
  bound(cut, bins, best, cut.first + bins.count_below(best.axis, best.bin), low, high);
  // Each comes to the place of the first high one, which takes its place (Lomuto's partition, without branches).
  BvhReference* middle = begin;
  for (BvhReference* r = begin; r != end; ++r) {
    const BvhReference here = *r;
    const Float4 at = here.middle();
    const bool is_low = best.is_low(places(at));
    *r = *middle;
    *middle = here;
    middle += is_low;
    add_middle(at, is_low, low, high);
  }
}

void BvhCutter::cut(const BvhRange& whole, BvhRange& low, BvhRange& high, BvhReference* scratch,
                    const Executor* executor) const {
  struct Chunk {
    Bins bins;
    std::size_t low_place, high_place;
    BvhRange low, high;
  };
  const BvhRange cut = whole;
  const Places places(cut);
  std::vector<Chunk> chunks((cut.size() + kChunk - 1) / kChunk);
  const auto begin_of = [&](std::size_t c) { return references_ + cut.first + c * kChunk; };
  const auto end_of = [&](std::size_t c) {
    return references_ + std::min(cut.last, cut.first + (c + 1) * kChunk);
  };
  parallel_for(executor, chunks.size(), [&](std::size_t c) { chunks[c].bins.add(places, begin_of(c), end_of(c)); });
  Bins bins;
  for (const Chunk& chunk : chunks) bins.add(chunk.bins);
  const Cut best = best_cut(bins, cut.size());
  if (best.bin == 0) return halve(whole, low, high);
  std::size_t low_place = 0, high_place = bins.count_below(best.axis, best.bin);
  bound(cut, bins, best, cut.first + high_place, low, high);
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    const std::size_t lows = chunks[c].bins.count_below(best.axis, best.bin);
    chunks[c].low_place = low_place;
    chunks[c].high_place = high_place;
    low_place += lows;
    high_place += static_cast<std::size_t>(end_of(c) - begin_of(c)) - lows;
  }
  parallel_for(executor, chunks.size(), [&](std::size_t c) {
    Chunk& chunk = chunks[c];
    for (const BvhReference *r = begin_of(c), *end = end_of(c); r != end; ++r) {
      const Float4 at = r->middle();
      const bool is_low = best.is_low(places(at));
      scratch[is_low ? chunk.low_place++ : chunk.high_place++] = *r;
      add_middle(at, is_low, chunk.low, chunk.high);
    }
  });
  parallel_for(executor, chunks.size(), [&](std::size_t c) {
    std::copy_n(scratch + c * kChunk, end_of(c) - begin_of(c), begin_of(c));
  });
  for (const Chunk& chunk : chunks) {
    low.middles.extend(chunk.low.middles);
    high.middles.extend(chunk.high.middles);
  }
}

}  // namespace umbrix::detail
