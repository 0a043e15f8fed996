// SPDX-License-Identifier: Apache-2.0
#include "tree/partition.h"

#include <algorithm>

#include "tree/clip.h"

namespace umbrix::detail {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// One side of a partition while it is filled.
struct Side {
  Cell& cell;
  std::uint32_t first_straddler = 0;

  void add(const Reference& r) { cell.references.push_back(r); }
  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(cell.references.size()); }
};

/// Where a parent's reference went: its side and number there, or kNone for a straddler.
using Place = std::uint32_t;
Place place(std::uint32_t index, std::uint32_t side) noexcept { return (index << 1) | side; }

Box intersection(const Box& a, const Box& b) noexcept {
  Box result;
  result.lower = glm::max(a.lower, b.lower);
  result.upper = glm::min(a.upper, b.upper);
  return result;
}

/// Adds the part of a straddling triangle that meets the side's cell, if any does.
void add_part(const Reference& r, const PartitionContext& context, Side& side) {
  Box box = intersection(r.box, side.cell.box);
  if (context.clip) {
    const Box part = clipped_bounds(context.triangles[r.triangle], side.cell.box, static_cast<double>(context.eps));
    if (part.empty()) return;
    box = intersection(box, grown(part, context.eps));
    if (box.empty()) return;
  }
  side.add({r.triangle, box});
}

void append_events(const Reference& r, std::uint32_t index, int axis, std::vector<Event>& events) {
  events.push_back(Event::start(r.box.lower[axis], index));
  events.push_back(Event::end(r.box.upper[axis], index));
}

/// One side's sorted events while they are written: the parent's in their order, the straddlers' merged in between.
class EventMerge {
 public:
  EventMerge(const Side& side, int axis, std::vector<Event>& out) {
    for (std::uint32_t i = side.first_straddler; i < side.size(); ++i)
      append_events(side.cell.references[i], i, axis, fresh_);
    std::sort(fresh_.begin(), fresh_.end());
    out.resize(2 * side.cell.references.size());
    next_ = fresh_.data();
    end_ = next_ + fresh_.size();
    to_ = out.data();
  }

  void add(const Event& e) {
    while (next_ != end_ && *next_ < e) *to_++ = *next_++;
    *to_++ = e;
  }
  void finish() { std::copy(next_, end_, to_); }

 private:
  std::vector<Event> fresh_;
  const Event* next_;
  const Event* end_;
  Event* to_;
};

/// Hands the parent's events on in their order, and merges in those of the straddlers.
void inherit_events(const std::vector<Event>& parent, const std::vector<Place>& places, int axis, Side (&sides)[2]) {
  const auto k = static_cast<std::size_t>(axis);
  EventMerge merges[2] = {{sides[0], axis, sides[0].cell.events[k]}, {sides[1], axis, sides[1].cell.events[k]}};
  for (const Event& e : parent) {
    const Place to = places[e.reference()];
    if (to != kNone) merges[to & 1u].add(e.renumbered(to >> 1));
  }
  for (EventMerge& merge : merges) merge.finish();
}

}  // namespace

void sort_events(Cell& cell) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Event>& events = cell.events[static_cast<std::size_t>(axis)];
    events.reserve(2 * cell.references.size());
    for (std::uint32_t i = 0; i < cell.references.size(); ++i) append_events(cell.references[i], i, axis, events);
    std::sort(events.begin(), events.end());
  }
}

void partition(Cell& cell, const Split& split, const PartitionContext& context, Cell& low, Cell& high) {
  const int axis = split.axis;
  const float plane = split.plane;
  low.box = high.box = cell.box;
  low.box.upper[axis] = plane;
  high.box.lower[axis] = plane;
  low.references.reserve(split.low_count);
  high.references.reserve(split.high_count);
  const std::size_t count = cell.references.size();
  Side sides[2] = {{low}, {high}};
  std::vector<Place> places(context.keep_events ? count : 0, kNone);

  // Hand over what lies on one side only, then cut the rest.
  std::vector<std::uint32_t> straddlers;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Reference& r = cell.references[i];
    const bool on_low = r.box.lower[axis]<plane, on_high = r.box.upper[axis]> plane;
    if (on_low && on_high) {
      straddlers.push_back(i);
      continue;
    }
    Side& side = sides[on_high ? 1 : 0];
    if (context.keep_events) places[i] = place(side.size(), on_high ? 1 : 0);
    side.add(r);
  }
  for (Side& side : sides) {
    side.first_straddler = side.size();
    for (const std::uint32_t i : straddlers) add_part(cell.references[i], context, side);
  }
  if (context.keep_events)
    for (int k = 0; k < 3; ++k) inherit_events(cell.events[static_cast<std::size_t>(k)], places, k, sides);
  cell = {};
}

}  // namespace umbrix::detail
