// SPDX-License-Identifier: Apache-2.0
#include "index/bvh_cutter.h"

#include <algorithm>
#include <numeric>
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
  Places(const BvhRange& whole, std::size_t bins) : origin_(whole.middles.lower) {
    const Float4 extent = whole.middles.extent();
    for (int axis = 0; axis < 3; ++axis) {
      const float scale = static_cast<float>(bins) / extent[axis];
      scale_[axis] = scale > 0 && scale < kInfinity ? scale : 0;
      last_[axis] = static_cast<float>(bins - 1);
    }
  }
  Int4 operator()(Float4 middle) const {
    const Float4 place = least((middle - origin_) * scale_, last_);
    return __builtin_convertvector(place > Float4{} ? place : Float4{}, Int4);
  }
  /// About where a bin begins.
  float start(int axis, std::size_t bin) const {
    return scale_[axis] > 0 ? origin_[axis] + static_cast<float>(bin) / scale_[axis] : origin_[axis];
  }

 private:
  Float4 origin_, scale_{}, last_{};
};

/// Bounds and numbers of what is in each bin, by axis.
class Bins {
 public:
  explicit Bins(std::size_t size) : size_(size) {
    for (int axis = 0; axis < 3; ++axis) {
      std::fill_n(bounds_[axis], size, BvhBounds());
      std::fill_n(counts_[axis], size, 0u);
    }
  }

  void add(const Places& places, const BvhReference* begin, const BvhReference* end) {
    for (const BvhReference* r = begin; r != end; ++r) {
      const Int4 place = places(r->middle());
      for (int axis = 0; axis < 3; ++axis) {
        bounds_[axis][place[axis]].extend(r->bounds);
        ++counts_[axis][place[axis]];
      }
    }
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < size_; ++i) {
        bounds_[axis][i].extend(other.bounds_[axis][i]);
        counts_[axis][i] += other.counts_[axis][i];
      }
    }
  }

  std::size_t size() const { return size_; }
  const BvhBounds& bounds(int axis, std::size_t bin) const { return bounds_[axis][bin]; }
  std::size_t count(int axis, std::size_t bin) const { return counts_[axis][bin]; }
  std::size_t count_below(int axis, std::size_t bin) const {
    return std::accumulate(counts_[axis], counts_[axis] + bin, std::size_t{0});
  }

 private:
  std::size_t size_;
  BvhBounds bounds_[3][kMostBins];
  std::uint32_t counts_[3][kMostBins];
};

/// Middles in bins below `bin` go to the low side.
struct Cut {
  float cost = kInfinity;
  int axis = 0;
  std::size_t bin = 0;

  bool exists() const { return bin != 0; }
};

void compare(const Bins& bins, int axis, Cut& best) {
  float high_cost[kMostBins];
  BvhBounds bounds;
  std::size_t references = 0;
  for (std::size_t bin = bins.size() - 1; bin > 0; --bin) {
    bounds.extend(bins.bounds(axis, bin));
    references += bins.count(axis, bin);
    high_cost[bin] = references == 0 ? kInfinity : bounds.area() * rows_of(references);
  }
  bounds = BvhBounds();
  references = 0;
  for (std::size_t bin = 1; bin < bins.size(); ++bin) {
    bounds.extend(bins.bounds(axis, bin - 1));
    references += bins.count(axis, bin - 1);
    if (references == 0) continue;
    const float cost = bounds.area() * rows_of(references) + high_cost[bin];
    if (cost < best.cost) best = {cost, axis, bin};
  }
}

Cut best_cut(const Bins& bins) {
  Cut best;
  for (int axis = 0; axis < 3; ++axis) compare(bins, axis, best);
  return best;
}

BvhBounds common(const BvhBounds& a, const BvhBounds& b) {
  return {-least(-a.lower, -b.lower), -least(-a.minus_upper, -b.minus_upper)};
}

/// Twice the bounds hold the middles, too.
BvhBounds twice(const BvhBounds& b) { return {b.lower + b.lower, b.minus_upper + b.minus_upper}; }

/// Where the sides begin and end, their bounds, and bounds of their middles, which need not be tight.
void part(const BvhRange& whole, const Places& places, const Bins& bins, const Cut& cut, BvhRange& low,
          BvhRange& high) {
  low = high = BvhRange();
  low.first = whole.first;
  low.last = high.first = whole.first + bins.count_below(cut.axis, cut.bin);
  high.last = whole.last;
  for (std::size_t i = 0; i < bins.size(); ++i) (i < cut.bin ? low : high).bounds.extend(bins.bounds(cut.axis, i));
  low.middles = common(whole.middles, twice(low.bounds));
  high.middles = common(whole.middles, twice(high.bounds));
  const float plane = places.start(cut.axis, cut.bin);
  low.middles.minus_upper[cut.axis] = std::max(low.middles.minus_upper[cut.axis], -plane);
  high.middles.lower[cut.axis] = std::max(high.middles.lower[cut.axis], plane);
}

/// Orders references so that those below the bin come first: each comes to the place of the first of the others, which
/// takes its place (Lomuto's partition, without branches that could not be foretold).
template <int kAxis>
void partition(const Places& places, std::int32_t bin, BvhReference* begin, const BvhReference* end) {
  BvhReference* middle = begin;
  for (BvhReference* r = begin; r != end; ++r) {
    const BvhReference here = *r;
    const bool is_low = places(here.middle())[kAxis] < bin;
    *r = *middle;
    *middle = here;
    middle += is_low;
  }
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

void BvhCutter::cut(const BvhRange& range_to_cut, BvhRange& low, BvhRange& high) const {
  BvhRange whole = range_to_cut;
  for (const bool is_tight : {false, true}) {
    if (is_tight) whole = range(whole.first, whole.last);
    Bins bins(bins_for(whole.size()));
    const Places places(whole, bins.size());
    BvhReference* const begin = references_ + whole.first;
    BvhReference* const end = references_ + whole.last;
    bins.add(places, begin, end);
    const Cut best = best_cut(bins);
    if (!best.exists()) continue;
    const auto bin = static_cast<std::int32_t>(best.bin);
    if (best.axis == 0) partition<0>(places, bin, begin, end);
    if (best.axis == 1) partition<1>(places, bin, begin, end);
    if (best.axis == 2) partition<2>(places, bin, begin, end);
    part(whole, places, bins, best, low, high);
    return;
  }
  halve(whole, low, high);  // middles that are all the same, or nearly
}

void BvhCutter::cut(const BvhRange& range_to_cut, BvhRange& low, BvhRange& high, BvhReference* scratch,
                    const Executor* executor) const {
  struct Chunk {
    Bins bins;
    std::size_t low_place, high_place;
  };
  const BvhRange whole = range_to_cut;
  const std::size_t bin_count = bins_for(whole.size());
  const Places places(whole, bin_count);
  std::vector<Chunk> chunks((whole.size() + kChunk - 1) / kChunk, {Bins(bin_count), 0, 0});
  const auto begin_of = [&](std::size_t c) { return references_ + whole.first + c * kChunk; };
  const auto end_of = [&](std::size_t c) { return references_ + std::min(whole.last, whole.first + (c + 1) * kChunk); };
  parallel_for(executor, chunks.size(), [&](std::size_t c) { chunks[c].bins.add(places, begin_of(c), end_of(c)); });
  Bins bins(bin_count);
  for (const Chunk& chunk : chunks) bins.add(chunk.bins);
  const Cut best = best_cut(bins);
  if (!best.exists()) return cut(whole, low, high);
  part(whole, places, bins, best, low, high);
  std::size_t low_place = 0, high_place = low.size();
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    const std::size_t lows = chunks[c].bins.count_below(best.axis, best.bin);
    chunks[c].low_place = low_place;
    chunks[c].high_place = high_place;
    low_place += lows;
    high_place += static_cast<std::size_t>(end_of(c) - begin_of(c)) - lows;
  }
  parallel_for(executor, chunks.size(), [&](std::size_t c) {
    std::size_t places_of[2] = {chunks[c].high_place, chunks[c].low_place};
    for (const BvhReference *r = begin_of(c), *end = end_of(c); r != end; ++r) {
      const bool is_low = places(r->middle())[best.axis] < static_cast<std::int32_t>(best.bin);
      scratch[places_of[is_low]++] = *r;
    }
  });
  parallel_for(executor, chunks.size(),
               [&](std::size_t c) { std::copy_n(scratch + c * kChunk, end_of(c) - begin_of(c), begin_of(c)); });
}

}  // namespace umbrix::detail
