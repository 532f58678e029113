#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace dominant_plane_detection {

/// A point and its squared distance to where it was searched from.
struct Neighbour {
  double squared_distance;  ///< [m^2]
  std::uint32_t point;

  bool operator<(const Neighbour& other) const {
    return std::tie(squared_distance, point) < std::tie(other.squared_distance, other.point);
  }
};

/// A k-d tree whose points can be taken out and put back. Each node knows how many of its points
/// are in, and empty ones are not entered: a search from the middle of what was taken out costs
/// little more than one at its edge.
class PointTree {
 public:
  /// @param points [m] all finite, copied; all are in.
  void build(const std::vector<Eigen::Vector3d>& points);

  std::size_t size() const { return nodes_.empty() ? 0 : nodes_.front().in; }  ///< [#] that are in
  bool contains(std::size_t point) const;
  /// @pre contains(point)
  void remove(std::size_t point);
  /// @pre !contains(point)
  void restore(std::size_t point);

  /// Finds the nearest points that are in, by distance and index.
  /// @param squared_radius [m^2] exclusive.
  /// @param count [#] of points at most, > 0.
  /// @param found in ascending order; fewer than `count` where the ball holds no more.
  void nearest(const Eigen::Vector3d& centre, double squared_radius, std::size_t count,
               std::vector<Neighbour>& found) const;

 private:
  /// A box that holds all of its points, those that were taken out included. The first child is the
  /// node that follows.
  struct Node {
    Eigen::Vector3d low;         ///< [m]
    Eigen::Vector3d high;        ///< [m]
    std::uint32_t begin;         ///< of its slots
    std::uint32_t in;            ///< [#] of its points; in a leaf they stand in its first slots
    std::uint32_t parent;        ///< of the root: itself
    std::uint32_t second_child;  ///< of a leaf: 0
  };
  struct Slot {
    Eigen::Vector3d position;  ///< [m]
    std::uint32_t point;
  };
  struct Query {
    Eigen::Vector3d centre;
    double squared_radius;
    std::size_t count;
    std::vector<Neighbour>& found;
  };

  void split(std::uint32_t begin, std::uint32_t end, std::uint32_t parent);
  void swapSlots(std::uint32_t a, std::uint32_t b);
  void count(std::uint32_t leaf, int change);
  void visit(std::uint32_t node, const Query& query) const;

  std::vector<Node> nodes_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> slot_of_;  ///< of each point
  std::vector<std::uint32_t> leaf_of_;  ///< of each slot
};

}  // namespace dominant_plane_detection
