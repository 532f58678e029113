#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// How the heights of a floor's readings over its plane err at some depth. NaN where there are too
/// few.
struct FloorNoiseFigures {
  double nearest = 0.0;   ///< [m] of the depth
  double farthest = 0.0;  ///< [m]
  std::size_t readings = 0;
  double height = 0.0;     ///< [m] rms
  double neighbour = 0.0;  ///< [m] standard deviation that the differences in a row tell
  double local = 0.0;      ///< [m] of blocks over the 7 x 7 about them, the largest of 4 to 16 px
  double smooth = 0.0;     ///< [m] standard deviation of means over 112 x 112 px
};

/// Measures a depth camera's errors on a floor: what config/sensors has of it.
///
/// The floor of an image is where most of 41 x 41 pixels are ground, with all readings there,
/// however far off the plane. All figures but `height` come from medians, as edges of things that
/// stand on the floor are among them.
class FloorNoise {
 public:
  /// @param detection of the image; without a plane it does not count.
  void add(const DepthView& depth, const CameraModel& camera, const Detection& detection);

  std::size_t images() const { return images_; }  ///< [#] that had a plane
  /// @return one for each half metre from 0.5 to 4.5 m.
  std::vector<FloorNoiseFigures> figures() const;
  /// @return [m] what the figures' `local` and `smooth` grow with depth like; least squares of
  /// constant + quadratic z^2, neither negative.
  /// @throw std::runtime_error where fewer than two depths have such figures.
  static NoiseModel localError(const std::vector<FloorNoiseFigures>& figures);
  static NoiseModel smoothError(const std::vector<FloorNoiseFigures>& figures);

 private:
  static constexpr std::size_t kBins = 8;
  static constexpr int kSizes = 3;  ///< blocks of 4, 8 and 16 px
  struct Bin {
    double square_height = 0.0;  ///< [m^2]
    std::size_t readings = 0;
    std::vector<float> windows;                     ///< [m]
    std::vector<float> differences;                 ///< [m]
    std::array<std::vector<float>, kSizes> locals;  ///< [m]
  };
  /// Heights of floor readings, 0 elsewhere, and 1 for these.
  struct Heights;
  void addPixels(const Heights& heights);
  void addBlocks(const Heights& heights, int size);
  void addWindows(const Heights& heights);
  Bin* binOf(double z);

  std::array<Bin, kBins> bins_;
  std::size_t images_ = 0;
};

}  // namespace dominant_plane_detection
