#pragma once

#include <libfreenect_registration.h>

#include <cstdint>
#include <vector>

namespace dominant_plane_detection::freenect_driver {

constexpr int kWidth = 640;   // [px]
constexpr int kHeight = 480;  // [px]

/// A Kinect's raw disparity as millimetres, and as the colour camera would see it.
class DepthTables {
 public:
  /// The usual calibration of a Kinect v1 (`DepthCalibration::kinect`); cannot register.
  DepthTables();
  /// The calibration that the device itself has.
  explicit DepthTables(const freenect_registration& device);

  bool registers() const { return !column_.empty(); }

  /// In place; 0 = no reading.
  /// @param readings [-] raw, kWidth * kHeight of them.
  void toMillimetres(std::uint16_t* readings) const;

  /// In place: raw disparity of the infrared camera to millimetres in the colour camera's image.
  /// Where several readings fall on a pixel the nearest stays.
  /// @pre registers()
  void toRegistered(std::uint16_t* readings);

 private:
  static constexpr int kFarthest = 10000;  // [mm] that libfreenect's tables know

  std::vector<std::uint16_t> millimetres_;  ///< [mm] by raw value
  // As libfreenect has them: columns are in 1/256 px.
  std::vector<std::int32_t> column_;  ///< where a pixel is seen, but for the shift by its distance
  std::vector<std::int32_t> row_;     ///< [px]
  std::vector<std::int32_t> shift_;   ///< by [mm]
  int first_row_ = 0;                 ///< [px] of the colour image above that of the depth image
  std::vector<std::uint16_t> raw_;    ///< a copy while an image is written anew
};

}  // namespace dominant_plane_detection::freenect_driver
