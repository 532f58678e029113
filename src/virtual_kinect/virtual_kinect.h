#pragma once

#include <cstdint>

namespace dominant_plane_detection::virtual_kinect {

/// What programs may ask of a virtual Kinect beyond OpenNI2's own properties and commands, by
/// `openni::Device::getProperty` and `invoke`. A device that is open twice in a process is one.

/// Where a depth frame was rendered from, and where its pixels were written.
struct FrameRecord {
  std::uint64_t timestamp;     ///< [us] of the device's clock, as in the frame
  std::uint64_t address;       ///< of the frame's first byte
  std::int64_t exposed;        ///< [ns] since 1970, when the timestamp was taken
  std::int64_t raised;         ///< [ns] of the steady clock, when the frame was handed to OpenNI2
  double scene_time;           ///< [s] on the scene's camera path
  std::uint32_t frame_number;  ///< seed of the frame's noise
  std::uint32_t registered;    ///< 1 when seen from the colour camera
};

/// Property: the latest depth frames, oldest first, `FrameRecord[n]` with n as the size allows.
constexpr int kFrameRecords = 0x6b76'0001;
/// Command: `double`, [s] from now until the device is unplugged.
constexpr int kUnplug = 0x6b76'0002;
/// Command: `double`, [s] from unplugging until it is plugged in again; negative: never.
constexpr int kReplugAfter = 0x6b76'0003;
/// Command: no data. Streams fall silent until they are started anew.
constexpr int kStall = 0x6b76'0004;
/// Command: `double`, [-] by which the device's clock is fast from now on.
constexpr int kDrift = 0x6b76'0005;

/// Command: `std::int32_t`, an OniSensorType, whose streams do not start from now on.
constexpr int kRefuseStart = 0x6b76'0006;

/// [us] that the colour camera exposes by itself, at a gain of 100. An image is as bright as both
/// are large, and white at most.
constexpr int kAutomaticExposure = 20000;
/// [m] the colour camera stands to the right of the depth camera, as on a Kinect v1.
constexpr double kColourOffset = 0.025;

}  // namespace dominant_plane_detection::virtual_kinect
