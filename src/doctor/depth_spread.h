#pragma once

#include <array>

#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// A unit that readings may be in by mistake.
struct DepthUnit {
  double factor;        ///< [-] that turns what is read into metres
  const char* meaning;  ///< in words, after "images are"
};

/// The common ones, and the reverse of each.
constexpr std::array<DepthUnit, 6> kDepthUnits{{
    {0.001, "in millimetres where metres are expected"},
    {1000.0, "in metres where millimetres are expected"},
    {0.1, "in units of 0.1 mm"},
    {10.0, "in centimetres"},
    {0.2, "in units of 1/5000 m"},
    {5.0, "in units of 5 mm"},
}};

/// How far away the things are that an image shows.
struct DepthSpread {
  double near = 0.0;            ///< [m] 10 % of the readings are nearer
  double median = 0.0;          ///< [m]
  double far = 0.0;             ///< [m] 5 % of the readings are farther
  bool multiples_of_5 = false;  ///< nearly all 16-bit readings are, as of 1/5000 m made from mm
  bool known = false;           ///< false: hardly a reading

  DepthSpread scaled(double factor) const;
};

/// @param depth every fourth pixel of every fourth row is looked at.
DepthSpread spreadOf(const DepthView& depth);

/// Whether a Kinect-class camera can have seen that; it sees what is 0.3 to 10 m away.
bool isPlausible(const DepthSpread& spread);
/// Whether it is all far away, in steps of 5 mm, as readings in units of 1/5000 m are.
bool isFarInSteps(const DepthSpread& spread);
/// Whether no such camera can: by far.
bool isImpossible(const DepthSpread& spread);

}  // namespace dominant_plane_detection
