#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dominant_plane_detection/noise_model.h"
#include "synthetic/smooth_error.h"

namespace dominant_plane_detection {

struct Rendering;

/// What a depth camera makes of the true depth; each effect can be switched off. The default is a
/// Kinect or an Xtion, the sensor that the scenes' camera and projector are those of: its readings
/// have a smooth error and steps of disparity, and neighbours in a row hardly differ.
struct SensorNoise {
  bool axial = true;              ///< normally distributed error of every pixel by itself
  NoiseModel model{0.0, 1.5e-4};  ///< its standard deviation
  bool smooth = true;             ///< error that neighbouring pixels share
  std::vector<ErrorOctave> octaves = kinectOctaves();  ///< its parts
  bool quantise = true;                                ///< disparity in steps of kDisparityStep
  bool shadows = true;       ///< no reading where the projector does not shine
  double drop_out = 0.0;     ///< [-] share of readings lost at random
  double min_cosine = 0.03;  ///< [-] of the angle of incidence, below which there is no reading
  double range_min = 0.4;    ///< [m] no reading nearer than this
  double range_max = 8.0;    ///< [m] no reading beyond this

  static constexpr double kBaseline = 0.075;       ///< [m] projector to the right of the camera
  static constexpr double kDisparityStep = 0.125;  ///< [px] a Kinect's eighth of a pixel

  /// A RealSense D4xx: bumps of about ten pixels, and no coarse steps.
  static SensorNoise realsense();
  /// Errors of `NoiseModel`'s default size, independent of each other, and quantised disparity: no
  /// sensor's, but what the detector's thresholds assume.
  static SensorNoise independent();
  /// Everything off but the range.
  static SensorNoise none();
  /// @param sensor kinect (the default), realsense or independent.
  /// @throw std::invalid_argument for another name; lists these.
  static SensorNoise named(const std::string& sensor);
};

/// @param frame number of the image: the same scene and number always give the same readings.
/// @return [mm] one reading a pixel, 0 for none.
std::vector<std::uint16_t> senseDepth(const Rendering& rendering, const SensorNoise& noise,
                                      std::uint32_t frame);

}  // namespace dominant_plane_detection
