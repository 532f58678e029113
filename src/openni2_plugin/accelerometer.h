#pragma once

namespace dominant_plane_detection::openni2_plugin {

/// What an accelerometer measures: at rest one g upwards, in the depth camera's optical frame (x
/// right, y down, z forward).
struct Acceleration {
  double x, y, z;  ///< [m/s^2]
};

/// Property of devices that have an accelerometer, beyond OpenNI2's own: `Acceleration`, read-only.
/// Reading it asks the device and may take a few ms.
constexpr int kAcceleration = 0x6b76'0010;

constexpr double kStandardGravity = 9.80665;  // [m/s^2]

}  // namespace dominant_plane_detection::openni2_plugin
