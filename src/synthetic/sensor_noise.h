#pragma once

#include <cstdint>
#include <vector>

#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

struct Rendering;

/// What a structured-light sensor makes of the true depth; each effect can be switched off.
struct SensorNoise {
  bool axial = true;  ///< normally distributed error of `model`'s standard deviation, every pixel
  NoiseModel model;   ///< sigma(z)
  bool quantise = true;     ///< disparity in steps of kDisparityStep
  bool shadows = true;      ///< no reading where the projector does not shine
  double correlated = 0.0;  ///< [1/m] standard deviation of a smooth error, per squared depth
  double correlation_length = 60;  ///< [px] shortest wave of the smooth error
  double drop_out = 0.0;           ///< [-] share of readings lost at random
  double min_cosine = 0.03;  ///< [-] of the angle of incidence, below which there is no reading
  double range_min = 0.4;    ///< [m] no reading nearer than this
  double range_max = 8.0;    ///< [m] no reading beyond this

  static constexpr double kBaseline = 0.075;       ///< [m] projector to the right of the camera
  static constexpr double kDisparityStep = 0.125;  ///< [px] a Kinect's eighth of a pixel

  /// Everything off but the range.
  static SensorNoise none();
};

/// @param frame number of the image: the same scene and number always give the same readings.
/// @return [mm] one reading a pixel, 0 for none.
std::vector<std::uint16_t> senseDepth(const Rendering& rendering, const SensorNoise& noise,
                                      std::uint32_t frame);

}  // namespace dominant_plane_detection
