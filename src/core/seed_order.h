#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace dominant_plane_detection {

/// The cells (pixels, tiles) of an image, those of its lower half first: the ground is most likely
/// there (section III.C). Lower is meant along the up direction, whichever way the camera is
/// turned, to the nearest of eight: what is known of up may change a little from image to image,
/// and seeds with it where two of these meet, no more.
class SeedOrder {
 public:
  /// Does nothing where all is as it was.
  /// @param columns, rows [#] of square cells that cover the image; none for an empty image.
  /// @param focal_lengths [px] (fx, fy), positive; only their ratio matters.
  /// @param up [-] unit, in the optical frame. Where it is within 5 degrees of the optical axis no
  /// half of the image is the lower one, and all cells come first.
  void build(int columns, int rows, const Eigen::Vector2d& focal_lengths,
             const Eigen::Vector3d& up);

  /// @return cell indices, row by row within either group: first the lower half, then the rest.
  const std::vector<std::size_t>& cells() const { return cells_; }
  /// @return [#] of cells in the first group. A cell in the middle is of the lower half.
  std::size_t firstGroup() const { return first_group_; }

 private:
  int columns_ = 0;
  int rows_ = 0;
  Eigen::Vector2d focal_lengths_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d direction_ = Eigen::Vector2d::Zero();  ///< [-] of up in the image
  std::vector<std::size_t> cells_;
  std::size_t first_group_ = 0;
};

}  // namespace dominant_plane_detection
