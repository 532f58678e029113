#pragma once

#include <cstdint>

namespace dominant_plane_detection::openni2_plugin {

/// Property of devices that have a motor, beyond OpenNI2's own: `double`, [rad] by which the camera
/// looks up from the horizon. Reading it asks the device and may take a few ms; it fails while a
/// Kinect's motor moves. Writing it begins the motion.
constexpr int kTiltAngle = 0x6b76'0011;
/// Of the same devices: `std::int32_t`, a `Led`. Can be written, and need not be readable.
constexpr int kLed = 0x6b76'0012;

/// [rad] as far as a Kinect's motor goes, up and down.
constexpr double kMostTilt = 0.54;

/// What the light on the front shows, in libfreenect's numbers.
enum class Led : std::int32_t {
  kOff = 0,
  kGreen = 1,
  kRed = 2,
  kYellow = 3,
  kBlinkGreen = 4,
  kBlinkGreenToo = 5,
  kBlinkRedYellow = 6,
};

}  // namespace dominant_plane_detection::openni2_plugin
