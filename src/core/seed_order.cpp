#include "core/seed_order.h"

namespace dominant_plane_detection {
namespace {

/// [-] length of up in the image plane (5 degrees) below which it says nothing about the image.
constexpr double kSmallestUp = 0.087;

}  // namespace

void SeedOrder::build(int columns, int rows, const Eigen::Vector2d& focal_lengths,
                      const Eigen::Vector3d& up) {
  if (columns == columns_ && rows == rows_ && focal_lengths == focal_lengths_ && up == up_) return;
  columns_ = columns;
  rows_ = rows;
  focal_lengths_ = focal_lengths;
  up_ = up;
  const Eigen::Vector2d up_in_image = up.head<2>();
  const bool no_lower_half = up_in_image.norm() < kSmallestUp;
  // Offsets from the image's middle, doubled so that they are whole numbers.
  const auto is_first = [&](int column, int row) {
    const Eigen::Vector2d offset(2 * column - (columns - 1), 2 * row - (rows - 1));
    return no_lower_half || offset.cwiseQuotient(focal_lengths).dot(up_in_image) <= 0.0;
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
