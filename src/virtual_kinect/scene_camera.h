#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "openni2_plugin/accelerometer.h"
#include "synthetic/renderer.h"
#include "synthetic/scene.h"

namespace dominant_plane_detection::virtual_kinect {

/// Makes a sensor's images of a scene whose camera path is driven forth and back.
class SceneCamera {
 public:
  /// Copies what it needs of the scene.
  explicit SceneCamera(const Scene& scene);

  /// The scene's camera at another resolution of the same shape.
  CameraModel camera(int width, int height) const;

  /// @param time [s] since the camera began to move.
  /// @return [s] on the scene's camera path.
  double sceneTime(double time) const;

  /// The camera looks up by an angle from where its path has it, from now on. From any thread.
  /// @param angle [rad]
  void setTilt(double angle) { tilt_ = angle; }
  double tilt() const { return tilt_; }

  /// @return what an accelerometer in the depth camera shows, which feels gravity alone.
  openni2_plugin::Acceleration acceleration(double scene_time) const;

  /// @param from_colour whether it is seen from the colour camera, as registered depth is.
  /// @param readings [mm], 0 for none; width * height values.
  void depth(double scene_time, bool from_colour, int width, int height, std::uint32_t frame,
             std::uint16_t* readings) const;
  /// Raw 11-bit disparity of a Kinect v1, 2047 for no reading.
  void disparity(double scene_time, int width, int height, std::uint32_t frame,
                 std::uint16_t* readings) const;
  /// Red, green and blue, from the colour camera's place.
  /// @param brightness [-] 1: as the scene has it.
  void colour(double scene_time, int width, int height, double brightness,
              std::uint8_t* pixels) const;
  /// Brightness in the infrared, 10 bits, from the depth camera's place.
  void infrared(double scene_time, int width, int height, std::uint16_t* pixels) const;

 private:
  const Renderer& renderer(int width, int height) const;
  Eigen::Isometry3d pose(double scene_time, bool from_colour) const;

  Scene scene_;
  std::atomic<double> tilt_{0.0};  ///< [rad]
  mutable std::mutex mutex_;       ///< streams of both resolutions may begin at the same time
  mutable std::map<std::pair<int, int>, std::unique_ptr<Renderer>> renderers_;
};

}  // namespace dominant_plane_detection::virtual_kinect
