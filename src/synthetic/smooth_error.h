#pragma once

#include <cstddef>
#include <vector>

#include "synthetic/pixel_noise.h"

namespace dominant_plane_detection {

/// A part of a sensor's smooth error: normally distributed numbers on a lattice over the image,
/// bilinear in between.
struct ErrorOctave {
  double spacing;    ///< [px] of the lattice, in an image 640 px wide
  double constant;   ///< [m] standard deviation along the surface's normal, constant part
  double quadratic;  ///< [1/m] per squared depth over the cosine of the angle of incidence
};

/// Of a Kinect's or an Xtion's readings, and of a RealSense D4xx's: fitted to recordings of floors,
/// see docs/scenes.md.
std::vector<ErrorOctave> kinectOctaves();
std::vector<ErrorOctave> realsenseOctaves();

/// The smooth error of one image, the sum of all octaves: a reading of the depth z at a cosine c is
/// off by constant + quadratic z^2 / c along the surface's normal.
class SmoothError {
 public:
  SmoothError(const std::vector<ErrorOctave>& octaves, int width, int height, PixelNoise& random);

  /// Fills the values of all pixels of row v.
  void row(int v, std::vector<float>& constant, std::vector<float>& quadratic) const;

 private:
  void add(const ErrorOctave& octave, double spacing, PixelNoise& random);

  // The sum is kept at every kStep-th pixel of every kStep-th row, bilinear in between.
  static constexpr int kStep = 4;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<float> constant_;
  std::vector<float> quadratic_;
};

}  // namespace dominant_plane_detection
