#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_correction.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// Learns a camera's `DepthCorrection` from the floors that it sees.
///
/// In inverse depth a plane is affine in the ray, so that a floor's readings are an affine
/// function, the plane of that image, plus what is fixed to the pixels, c, plus errors. Least
/// squares over all images for both: the planes are eliminated one by one (Schur complement), c is
/// smooth and small where little is known of it. Its own affine part cannot be told from the
/// planes: it is such that on average they do not move.
///
/// Prior work corrects depth by a wall or by a map (A. Teichman, S. Miller, S. Thrun, RSS 2013;
/// F. Basso, E. Menegatti, A. Pretto, IEEE T-RO 34(5), 2018).
class FloorCorrection {
 public:
  /// What was learned, and what it leaves on images that it was not learned from: one fifth of
  /// neighbouring images after the other is left out.
  struct Result {
    DepthCorrection::Grid grid;
    double before = 0.0;  ///< [1/m] median over images of the rms of cells over their plane
    double after = 0.0;   ///< [1/m] the same with the correction
    std::size_t images = 0;
  };

  /// @param noise by which readings weigh.
  explicit FloorCorrection(const NoiseModel& noise) : noise_(noise) {}

  /// @param detection of the image; without a plane it does not count.
  void add(const DepthView& depth, const CameraModel& camera, const Detection& detection);

  std::size_t images() const { return images_.size(); }  ///< [#] that count

  /// @throw std::runtime_error in one sentence where the images do not determine a correction, or
  /// where it would not help: the error is not fixed to the pixels.
  Result learn() const;

 private:
  /// The floor in the cells of one image.
  struct Image {
    Eigen::VectorXd weight;  ///< [-] 0 to 1
    Eigen::VectorXd
        plane_weight;  ///< of a plane's fit, by readings and their error along its normal
    Eigen::VectorXd inverse_depth;  ///< [1/m] over the image's plane
    Eigen::MatrixX3d ray;           ///< [-] (X/Z, Y/Z, 1), means
  };

  struct Sums;

  void keep(const Sums& sums, double pixels);
  Eigen::MatrixXd bending() const;
  Eigen::VectorXd solve(const std::vector<const Image*>& images,
                        const Eigen::MatrixXd& bending) const;
  static Eigen::VectorXd withoutPlanes(const Eigen::VectorXd& correction,
                                       const std::vector<const Image*>& images);
  static double unevenness(const Image& image, const Eigen::VectorXd& correction);

  NoiseModel noise_;
  RayTable rays_;
  int columns_ = 0, rows_ = 0;
  std::vector<Image> images_;
};

}  // namespace dominant_plane_detection
