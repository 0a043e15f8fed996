// SPDX-License-Identifier: Apache-2.0
// Walked with a stack of our own: files may nest deeper than the machine's.

#include "io/node_hierarchy.h"

#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

std::string node_label(const tinygltf::Model& model, std::size_t node) {
  return label_of("nodes", node, model.nodes[node].name);
}

}  // namespace

NodeHierarchy::NodeHierarchy(const Conversion& conversion)
    : model_(conversion.model), most_depth_(conversion.limits.node_depth), place_(model_.nodes.size(), -1) {
  find_parents();
  refuse_cycles();
  walk_from(scene_roots(), true);
}

void NodeHierarchy::find_parents() {
  parent_.assign(model_.nodes.size(), -1);
  for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
    for (const int child : model_.nodes[n].children) {
      int& parent = parent_[static_cast<std::size_t>(child)];
      if (parent >= 0) {
        bad_input("{}: is the child of two nodes, {} and {}", node_label(model_, static_cast<std::size_t>(child)),
                  parent, n);
      }
      parent = static_cast<int>(n);
    }
  }
}

// With one parent each, a node is on or below a cycle exactly if going up never ends.
void NodeHierarchy::refuse_cycles() const {
  enum : char { kUnknown, kOnPath, kGood };
  std::vector<char> state(model_.nodes.size(), kUnknown);
  std::vector<std::size_t> path;
  for (std::size_t start = 0; start < model_.nodes.size(); ++start) {
    path.clear();
    for (int n = static_cast<int>(start); n >= 0; n = parent_[static_cast<std::size_t>(n)]) {
      char& s = state[static_cast<std::size_t>(n)];
      if (s == kOnPath) bad_input("{}: is its own ancestor", node_label(model_, static_cast<std::size_t>(n)));
      if (s == kGood) break;
      s = kOnPath;
      path.push_back(static_cast<std::size_t>(n));
    }
    for (const std::size_t n : path) state[n] = kGood;
  }
}

std::vector<int> NodeHierarchy::scene_roots() const {
  std::vector<int> roots;
  if (model_.scenes.empty()) {
    for (std::size_t n = 0; n < parent_.size(); ++n) {
      if (parent_[n] < 0) roots.push_back(static_cast<int>(n));
    }
    return roots;
  }
  const int number = model_.defaultScene >= 0 ? model_.defaultScene : 0;
  roots = model_.scenes[static_cast<std::size_t>(number)].nodes;
  std::vector<char> listed(model_.nodes.size(), 0);
  for (const int root : roots) {
    const auto n = static_cast<std::size_t>(root);
    if (parent_[n] >= 0)
      bad_input("{}: is a root of scenes[{}] and a child of node {}", node_label(model_, n), number, parent_[n]);
    if (listed[n]) bad_input("{}: is listed twice in scenes[{}]", node_label(model_, n), number);
    listed[n] = 1;
  }
  return roots;
}

void NodeHierarchy::walk_from(const std::vector<int>& roots, bool shown) {
  std::vector<Step> stack;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    stack.push_back({static_cast<std::uint32_t>(*root), -1, 0, shown});
  }
  while (!stack.empty()) {
    const Step step = stack.back();
    stack.pop_back();
    if (step.depth > most_depth_) {
      over_limit("{}: nested deeper than {} nodes", node_label(model_, step.node), most_depth_);
    }
    const auto place = static_cast<std::int32_t>(walk_.size());
    place_[step.node] = place;
    walk_.push_back(step);
    const std::vector<int>& children = model_.nodes[step.node].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      stack.push_back({static_cast<std::uint32_t>(*child), place, step.depth + 1, shown});
    }
  }
}

void NodeHierarchy::include(const std::vector<int>& nodes) {
  for (int n : nodes) {
    while (place_[static_cast<std::size_t>(n)] < 0 && parent_[static_cast<std::size_t>(n)] >= 0) {
      n = parent_[static_cast<std::size_t>(n)];
    }
    if (place_[static_cast<std::size_t>(n)] < 0) walk_from({n}, false);
  }
}

void NodeHierarchy::mark_path(std::size_t node, std::vector<char>& marks) const {
  for (auto n = static_cast<int>(node); n >= 0; n = parent_[static_cast<std::size_t>(n)]) {
    char& mark = marks[static_cast<std::size_t>(n)];
    if (mark) return;
    mark = 1;
  }
}

}  // namespace umbrix::io::detail
