#pragma once

#include <string>

namespace dominant_plane_detection::virtual_kinect {

constexpr const char* kScheme = "virtual://";

/// What a URI `virtual://SCENE?name=value&...` asks for.
struct VirtualUri {
  std::string scene;            ///< file of the scene, absolute
  std::string serial = "VK00";  ///< serial number of the device
  bool noise = true;            ///< the sensor's noise, or none
  std::string sensor;           ///< a name that `SensorNoise::named` knows; empty: the scene's own
  double start = 0.0;           ///< [s] on the scene's camera path, at which it begins
  double drift = 0.0;           ///< [-] by which the device's clock is fast
  double unplug = -1.0;         ///< [s] after opening, < 0: never
  double replug = -1.0;         ///< [s] after unplugging, < 0: never
  double stall = -1.0;          ///< [s] after opening, at which streams fall silent, < 0: never
  double sent = 1.0;      ///< [-] share of each frame that is sent; the rest is an earlier one's
  double slow = 0.0;      ///< [s] that opening takes
  bool registers = true;  ///< or fails to, though it says that it could
};

/// @param scenes folder in which a scene without a slash in its name is looked for; ".yaml" may be
/// left out there.
/// @throw std::invalid_argument for an unknown name or a value that is no number.
VirtualUri parseUri(const std::string& uri, const std::string& scenes);

}  // namespace dominant_plane_detection::virtual_kinect
