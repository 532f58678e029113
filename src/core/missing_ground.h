#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/hesse_plane.h"
#include "core/image_kernel.h"
#include "core/tile_moments.h"

namespace dominant_plane_detection {

/// Finds where ground should be seen and no reading came: holes, glass, black or sunlit floor.
///
/// Looked at are blocks of 4 x 4 pixels half of which have no reading, where the plane is within
/// the range. What an obstacle hides from the second eye of the sensor, camera or projector, is
/// left out: the part of a row next to something nearer that is as wide as its parallax. Of what
/// hangs together most of the rim has to be ground; the image's border is none.
class MissingGround {
 public:
  /// @param plane of the ground.
  /// @param tiles of the image, for how many readings they have.
  /// @param min_width [m] of the square that is as large as the smallest piece.
  /// @param labels one `Label` a pixel; readings that are missing become kMissingGround.
  void mark(const ImageInput& input, const HessePlane& plane, const TileMoments& tiles,
            double min_width, std::vector<std::uint8_t>& labels);

 private:
  struct Piece {
    double area = 0.0;       ///< [m^2] on the plane
    std::size_t rim = 0;     ///< [#] sides of its blocks that are no other's
    std::size_t ground = 0;  ///< [#] of these, those beyond which ground begins
  };
  struct Step {
    int column, row;
  };
  /// The image, and the plane that is seen in it.
  struct Sight {
    const ImageInput& input;
    Eigen::Vector3f normal;  ///< [-]
    float distance;          ///< [m]

    /// @return [m] the plane's depth in a pixel; 0 where that is out of range, or the ray unknown.
    float planeDepth(int u, int v) const;
  };

  template <typename Pixel>
  void findEmpty(const Sight& sight, const TileMoments& tiles);
  void leaveOutShadows(const ImageInput& input);
  void leaveOutShadow(const ImageInput& input, int row, int begin, int end, int step);
  Piece grow(std::size_t start, const Sight& sight, const std::vector<std::uint8_t>& labels);
  bool leadsToGround(int column, int row, Step step, const ImageInput& input,
                     const std::vector<std::uint8_t>& labels) const;
  void label(const Sight& sight, std::vector<std::uint8_t>& labels) const;

  bool inside(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  std::size_t indexOf(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_ = 0, rows_ = 0;       ///< [#] of blocks
  std::vector<std::uint8_t> state_;  ///< of each block, row-major
  std::vector<float> plane_depth_;   ///< [m] of those that are empty
  std::vector<std::size_t> blocks_;  ///< of one piece
  std::vector<std::size_t> found_;   ///< all that are empty, in the image's order
};

}  // namespace dominant_plane_detection
