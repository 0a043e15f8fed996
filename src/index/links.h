// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/lazy_array.h"
#include "index/side_table.h"
#include "tree/tree.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

/// Where a link leads: to a leaf, or to the inner node whose cell covers the whole face.
class Link {
 public:
  Link() = default;
  explicit Link(std::uint32_t bits) noexcept : bits_(bits) {}
  static Link to_leaf(std::uint32_t record) noexcept { return Link((record << 1) | 1u); }
  static Link to_inner(std::uint32_t node) noexcept { return Link(node << 1); }

  std::uint32_t bits() const noexcept { return bits_; }
  bool is_set() const noexcept { return bits_ != 0; }
  bool is_leaf() const noexcept { return (bits_ & 1u) != 0; }
  std::uint32_t target() const noexcept { return bits_ >> 1; }  ///< record or node

 private:
  std::uint32_t bits_ = 0;  ///< unset
};

/// A leaf as a walk from leaf to leaf sees it, in one cache line. The faces on the root's box are infinite: a plane
/// there could round to just before the ray's end and cut off the last cells, so nothing leaves through them.
struct alignas(64) LinkedLeaf {
  float faces[kFaces];
  std::atomic<std::uint32_t> links[kFaces];
  BlockRun blocks;
  std::uint32_t node;
};
static_assert(sizeof(LinkedLeaf) == 64);

/// How links come into being. All ways make the same ones; they differ in which are there.
enum class LinkBuilder {
  full,     ///< all, before the first ray (Popov et al. 2007)
  reached,  ///< before the first ray, breadth-first from the lights' leaves over touched ones (Liang & Huang 2019)
  lazy,     ///< each by the first ray that wants it
};

/// Links between the leaves of a tree ("ropes", Havran 2000): each names the smallest node whose cell covers the whole
/// face. They do not depend on any light. Any number of threads may follow them and, if lazy, add to them.
class Links : public SideTable {
 public:
  /// None yet; `tree` must outlive them. Throws std::bad_alloc.
  Links(const Tree& tree, LinkBuilder builder);

  bool is_lazy() const noexcept { return builder_ == LinkBuilder::lazy; }
  std::uint64_t bytes() const noexcept override;

  /// Leaves that have a record. Records are numbered from 1.
  std::uint32_t leaf_count() const noexcept { return leaf_count_.load(std::memory_order_relaxed); }
  const LinkedLeaf& leaf(std::uint32_t record) const noexcept { return leaves_[record]; }

  /// The record of a leaf node, made if the links are lazy; 0 if there is none.
  std::uint32_t record_of(std::uint32_t node) const noexcept {
    const std::uint32_t record = records_[node].load(std::memory_order_acquire);
    return record != 0 || !is_lazy() ? record : add(node);
  }

  /// Where a face leads, found if the links are lazy; unset if it is not known. Not for faces on the root's box.
  Link follow(const LinkedLeaf& leaf, std::uint32_t face) const noexcept {
    const Link link(leaf.links[face].load(std::memory_order_acquire));
    return link.is_set() || !is_lazy() ? link : find(leaf, face);
  }

  /// Makes a record and all links for every leaf.
  void build_full(const Executor* executor);

  /// Makes records for the leaves that `touched` marks by node, and the links between those of them that can be reached
  /// over touched leaves from the leaves of the lights (in the tree's units).
  void build_reached(const std::vector<Vec3>& lights, const std::vector<bool>& touched);

 private:
  std::uint32_t take_record() const noexcept;
  void give_back(std::uint32_t record) const noexcept;
  std::uint32_t add(std::uint32_t node) const noexcept;
  std::uint32_t add(std::uint32_t node, const Box& cell) const noexcept;
  void add_below(std::uint32_t node, const Box& cell);
  Link find(const LinkedLeaf& leaf, std::uint32_t face) const noexcept;
  void find_all(std::uint32_t node, const std::uint32_t (&outside)[kFaces]);

  const Tree& tree_;
  LinkBuilder builder_;
  // Growing lazily cannot be seen by a caller: hence mutable behind const.
  LazyArray<LinkedLeaf> leaves_;                   ///< by record
  LazyArray<std::atomic<std::uint32_t>> records_;  ///< by node
  mutable std::atomic<std::uint32_t> next_record_{1};
  mutable std::atomic<std::uint32_t> given_back_[16] = {};  ///< of several threads that want a leaf at once
  mutable std::atomic<std::uint32_t> leaf_count_{0};        ///< without records that two threads made of one leaf
};

}  // namespace umbrix::detail
