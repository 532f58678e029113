#include "core/seed_order.h"

#include <cmath>

namespace dominant_plane_detection {
namespace {

/// [-] length of up in the image plane (5 degrees) below which it says nothing about the image.
constexpr double kSmallestUp = 0.087;

/// @return [-] which of eight directions up is nearest to in the image, along x, y or both; zero
/// where it says nothing.
Eigen::Vector2d directionOf(const Eigen::Vector3d& up) {
  constexpr double kFlat = 0.41421356;  // tan(22.5 degrees)
  const Eigen::Vector2d in_image = up.head<2>();
  if (in_image.norm() < kSmallestUp) return Eigen::Vector2d::Zero();
  const double least = kFlat * in_image.cwiseAbs().maxCoeff();
  const auto sign = [&](double value) {
    return std::abs(value) < least ? 0.0 : std::copysign(1.0, value);
  };
  return {sign(in_image.x()), sign(in_image.y())};
}

}  // namespace

void SeedOrder::build(int columns, int rows, const Eigen::Vector2d& focal_lengths,
                      const Eigen::Vector3d& up) {
  const Eigen::Vector2d direction = directionOf(up);
  if (columns == columns_ && rows == rows_ && focal_lengths == focal_lengths_ &&
      direction == direction_) {
    return;
  }
  columns_ = columns;
  rows_ = rows;
  focal_lengths_ = focal_lengths;
  direction_ = direction;
  // Offsets from the image's middle, doubled so that they are whole numbers.
  const auto is_first = [&](int column, int row) {
    const Eigen::Vector2d offset(2 * column - (columns - 1), 2 * row - (rows - 1));
    return offset.cwiseQuotient(focal_lengths).dot(direction) <= 0.0;  // all, without a direction
  };
  cells_.clear();
  for (const bool first : {true, false}) {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        if (is_first(column, row) != first) continue;
        cells_.push_back(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                         static_cast<std::size_t>(column));
      }
    }
    if (first) first_group_ = cells_.size();
  }
}

}  // namespace dominant_plane_detection
