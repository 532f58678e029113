#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace dominant_plane_detection {

/// Where the cells of a square are that moves over a plane: a cell keeps its place in memory while
/// the square moves, and what leaves on one side makes room for what comes in on the other.
class RollingGrid {
 public:
  /// @param resolution [m] side of a cell. @param cells [#] on each side of the square.
  RollingGrid(double resolution, int cells) : resolution_(resolution), cells_(cells) {}

  double resolution() const { return resolution_; }
  int cells() const { return cells_; }
  std::size_t size() const { return static_cast<std::size_t>(cells_ * cells_); }
  /// @return [m] the corner of the square where x and y are smallest.
  Eigen::Vector2d origin() const { return resolution_ * first_.cast<double>(); }

  /// Moves the square so that a point is in its middle.
  /// @param point [m] @param forget called with the place of each cell that came in.
  template <typename Forget>
  void moveTo(const Eigen::Vector2d& point, Forget&& forget) {
    const Eigen::Vector2i old = first_;
    first_ = cellOf(point) - Eigen::Vector2i::Constant(cells_ / 2);
    turn_ = {wrap(first_.x()), wrap(first_.y())};
    if (first_ == old) return;
    for (int y = 0; y < cells_; ++y) {
      for (int x = 0; x < cells_; ++x) {
        const Eigen::Vector2i before = first_ + Eigen::Vector2i(x, y) - old;
        const bool stays = before.minCoeff() >= 0 && before.maxCoeff() < cells_;
        if (!stays) forget(placeOf(x, y));
      }
    }
  }

  /// @param x, y [#] of a cell, from the origin on. @pre both are below `cells()`.
  std::size_t placeOf(int x, int y) const {
    const int column = turn_.x() + x, row = turn_.y() + y;
    return static_cast<std::size_t>((row < cells_ ? row : row - cells_) * cells_ +
                                    (column < cells_ ? column : column - cells_));
  }

 private:
  Eigen::Vector2i cellOf(const Eigen::Vector2d& point) const {
    return (point / resolution_).array().floor().cast<int>();
  }
  int wrap(int i) const { return (i % cells_ + cells_) % cells_; }

  double resolution_;
  int cells_;
  Eigen::Vector2i first_ = Eigen::Vector2i::Zero();  ///< [#] the cell at the origin
  Eigen::Vector2i turn_ = Eigen::Vector2i::Zero();   ///< [#] and where it is in memory
};

}  // namespace dominant_plane_detection
