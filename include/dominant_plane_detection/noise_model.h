#pragma once

namespace dominant_plane_detection {

/// Standard deviation of a depth reading, sigma(z) = constant + quadratic z^2.
///
/// The quadratic term is the random error of a Kinect v1, 1.425e-3 z^2 m: K. Khoshelham and
/// S. O. Elberink, "Accuracy and Resolution of Kinect Depth Data for Indoor Mapping Applications",
/// Sensors 12(2), 2012 (Eq. 8 with m/(f b) = 2.85e-5 per cm and half a pixel of disparity error).
/// The constant stands for what does not grow with distance: the millimetre grid of the readings,
/// the lens, and an uneven floor.
struct NoiseModel {
  double constant = 0.002;      ///< [m]
  double quadratic = 1.425e-3;  ///< [1/m]

  /// @param z [m] depth along the optical axis.
  /// @return [m]
  double sigma(double z) const { return constant + quadratic * z * z; }
};

/// Size of the error that a large part of an image shares, along a surface's normal:
/// constant + quadratic z^2 / cos of the angle of incidence. No fit can tell it from the surface.
/// The numbers are those that the floors and tables of recordings with a Kinect and an Xtion show,
/// by their halves against each other (docs/method.md).
struct WideErrorModel {
  double constant = 0.010;  ///< [m]
  double quadratic = 8e-4;  ///< [1/m]

  /// @param z [m] depth along the optical axis.
  /// @param cosine [-] of the angle of incidence.
  /// @return [m]
  double size(double z, double cosine) const { return constant + quadratic * z * z / cosine; }
};

/// A threshold t(z) = offset + sigmas * sigma(z): constant as in the paper with sigmas = 0, scaled
/// with the sensor's noise with offset = 0.
struct DepthThreshold {
  double offset = 0.0;  ///< [m]
  double sigmas = 0.0;  ///< [-]

  /// @return [m]
  double at(double z, const NoiseModel& noise) const { return offset + sigmas * noise.sigma(z); }
};

}  // namespace dominant_plane_detection
