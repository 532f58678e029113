#include "core/point_tree.h"

#include <algorithm>

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kLeafSize = 16;

/// Rounds like the distance to any point of the box, so it never exceeds it.
double squaredDistance(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                       const Eigen::Vector3d& r) {
  return (r - r.cwiseMax(low).cwiseMin(high)).squaredNorm();
}

}  // namespace

void PointTree::build(const std::vector<Eigen::Vector3d>& points) {
  const auto count = static_cast<std::uint32_t>(points.size());
  nodes_.clear();
  slots_.resize(count);
  slot_of_.resize(count);
  leaf_of_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) slots_[i] = {points[i], i};
  if (count > 0) split(0, count, 0);
  for (std::uint32_t i = 0; i < count; ++i) slot_of_[slots_[i].point] = i;
}

/// Makes the node of [begin, end) and all below it: halves of equal size along the longest side.
void PointTree::split(std::uint32_t begin, std::uint32_t end, std::uint32_t parent) {
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  Eigen::Vector3d low = slots_[begin].position, high = low;
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    low = low.cwiseMin(slots_[i].position);
    high = high.cwiseMax(slots_[i].position);
  }
  nodes_.push_back({low, high, begin, end - begin, parent, 0});
  if (end - begin <= kLeafSize) {
    std::fill(leaf_of_.begin() + begin, leaf_of_.begin() + end, self);
    return;
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      slots_.begin() + begin, slots_.begin() + middle, slots_.begin() + end,
      [axis](const Slot& a, const Slot& b) { return a.position[axis] < b.position[axis]; });
  split(begin, middle, self);
  nodes_[self].second_child = static_cast<std::uint32_t>(nodes_.size());
  split(middle, end, self);
}

bool PointTree::contains(std::size_t point) const {
  const std::uint32_t slot = slot_of_[point];
  const Node& leaf = nodes_[leaf_of_[slot]];
  return slot < leaf.begin + leaf.in;
}

void PointTree::remove(std::size_t point) {
  const std::uint32_t leaf = leaf_of_[slot_of_[point]];
  count(leaf, -1);
  swapSlots(slot_of_[point], nodes_[leaf].begin + nodes_[leaf].in);
}

void PointTree::restore(std::size_t point) {
  const std::uint32_t leaf = leaf_of_[slot_of_[point]];
  swapSlots(slot_of_[point], nodes_[leaf].begin + nodes_[leaf].in);
  count(leaf, 1);
}

void PointTree::swapSlots(std::uint32_t a, std::uint32_t b) {
  std::swap(slots_[a], slots_[b]);
  slot_of_[slots_[a].point] = a;
  slot_of_[slots_[b].point] = b;
}

void PointTree::count(std::uint32_t leaf, int change) {
  for (std::uint32_t node = leaf;; node = nodes_[node].parent) {
    nodes_[node].in += static_cast<std::uint32_t>(change);
    if (node == 0) return;
  }
}

void PointTree::nearest(const Eigen::Vector3d& centre, double squared_radius, std::size_t count,
                        std::vector<Neighbour>& found) const {
  found.clear();
  if (size() > 0) visit(0, {centre, squared_radius, count, found});
}

void PointTree::visit(std::uint32_t node, const Query& query) const {
  const Node& here = nodes_[node];
  std::vector<Neighbour>& found = query.found;
  if (here.second_child == 0) {
    for (std::uint32_t i = here.begin; i < here.begin + here.in; ++i) {
      const Neighbour candidate{(query.centre - slots_[i].position).squaredNorm(), slots_[i].point};
      if (!(candidate.squared_distance < query.squared_radius)) continue;
      if (found.size() == query.count) {
        if (!(candidate < found.back())) continue;
        found.pop_back();
      }
      found.insert(std::upper_bound(found.begin(), found.end(), candidate), candidate);
    }
    return;
  }
  struct Child {
    double squared_distance;
    std::uint32_t node;
  };
  const auto child = [&](std::uint32_t index) {
    return Child{squaredDistance(nodes_[index].low, nodes_[index].high, query.centre), index};
  };
  Child children[] = {child(node + 1), child(here.second_child)};
  if (children[1].squared_distance < children[0].squared_distance) {
    std::swap(children[0], children[1]);
  }
  for (const Child& next : children) {
    // As near as the farthest that was found is near enough: the index may be lower.
    const bool may_hold = found.size() < query.count
                              ? next.squared_distance < query.squared_radius
                              : next.squared_distance <= found.back().squared_distance;
    if (may_hold && nodes_[next.node].in > 0) visit(next.node, query);
  }
}

}  // namespace dominant_plane_detection
