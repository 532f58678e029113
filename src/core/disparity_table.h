#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "dominant_plane_detection/depth_calibration.h"

namespace dominant_plane_detection {

/// A depth calibration as a table: raw 11-bit disparity in, millimetres out.
class DisparityTable {
 public:
  static constexpr std::size_t kSize = 2048;  ///< [#] of raw values

  /// Z' = scale Z + offset, rounded to millimetres; 0, "no reading", where the calibration has none
  /// and where the result leaves the range of 16 bits.
  /// @param offset [m]
  /// @param scale [-]
  explicit DisparityTable(const DepthCalibration& calibration, double offset = 0.0,
                          double scale = 1.0);

  /// @return [mm]; 0 for raw values of 2047 and more.
  std::uint16_t operator[](std::uint16_t raw) const {
    return raw < kSize ? millimetres_[raw] : std::uint16_t{0};
  }

  /// @param raw [-] n readings.
  /// @param millimetres [mm] n of them; may be where `raw` is.
  void apply(const std::uint16_t* raw, std::size_t n, std::uint16_t* millimetres) const;

 private:
  std::array<std::uint16_t, kSize> millimetres_;
};

}  // namespace dominant_plane_detection
