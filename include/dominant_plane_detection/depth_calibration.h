#pragma once

#include <cstdint>

namespace dominant_plane_detection {

/// From the raw 11-bit depth value D of a structured-light sensor to the distance Z, in one of two
/// forms.
///
///   exponential (Eq. 1):  Z = a exp(b D) + c exp(d D)
///   reciprocal:           Z = 1 / (a + b D), what triangulation predicts for a disparity D
///
/// All constants are in metres (a, c of Eq. 1) or 1/metres (a, b of the reciprocal form).
struct DepthCalibration {
  enum class Form : std::uint8_t { kExponential, kReciprocal };

  Form form = Form::kReciprocal;
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;  ///< exponential form only
  double d = 0.0;  ///< exponential form only

  /// The constants printed with Eq. 1, in metres. They describe another scaling of D than the raw
  /// disparity of a Kinect v1: use `kinect()` for driving.
  static DepthCalibration paper();

  /// The widely used fit to the raw disparity of a Kinect v1 (ROS wiki,
  /// kinect_calibration/technical).
  static DepthCalibration kinect();

  /// @param raw [-] D
  /// @return [m] what the form gives, be it a possible distance or not.
  double evaluate(double raw) const;

  /// @param raw [-] D, 0 to 2047; 2047 is the sensor's "no reading".
  /// @return [m] Z, or 0 for "no reading": D = 2047, and any D whose Z is not a finite positive
  /// distance.
  double distance(int raw) const;
};

}  // namespace dominant_plane_detection
