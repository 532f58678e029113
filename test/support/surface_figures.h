#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "dominant_plane_detection/parameters.h"
#include "synthetic/surface_scenes.h"

namespace dominant_plane_detection {

/// Whose error the readings of a scene have.
enum class ErrorKind : std::uint8_t {
  kSmooth,     ///< in depth, rms 0.8 sigma(z), 20 to 40 px long, and white noise of 0.25 sigma(z)
  kKinect,     ///< as recorded, see docs/scenes.md
  kRealsense,  ///< the same
};

/// @return [mm] the readings of a rendering with shadows.
std::vector<std::uint16_t> readDepth(const Rendering& rendering, ErrorKind error,
                                     std::uint32_t seed);

/// @return the defaults with the smooth error of such readings, as `FloorNoise` measures it.
Parameters parametersOf(ErrorKind error);

/// A plane against a true surface.
struct SurfaceError {
  double angle = 0.0;   ///< [rad] between the normals
  double height = 0.0;  ///< [m] of the camera over it, absolute difference
  /// @return [-] the larger of the two, in 0.3 degrees and 5 mm.
  double relative() const;
};

/// An image of a scene, with the truth about it.
class SurfaceImage {
 public:
  SurfaceImage(const SurfaceScene& scene, ErrorKind error, std::uint32_t seed);

  DepthView view() const;
  const CameraModel& camera() const { return camera_; }
  /// @return the surfaces in the optical frame: offset is -distance.
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  /// @return [px] readings of a surface between 0.5 and 4 m.
  std::size_t readings(std::size_t surface) const;
  /// @return the true surface that a plane is nearest to.
  std::size_t nearest(const Eigen::Vector3d& normal, double distance) const;
  SurfaceError error(const Eigen::Vector3d& normal, double distance, std::size_t surface) const;
  /// @return the error of a plane fitted to the readings of a surface, weighted by 1 / sigma(z)^2;
  /// nothing where they are too few.
  std::optional<SurfaceError> fitError(std::size_t surface) const;
  /// @return [m] to the nearest surface parallel to one; nothing where there is none, or another
  /// surface is not parallel to it.
  std::optional<double> stepFrom(std::size_t surface) const;

 private:
  CameraModel camera_;
  std::vector<Surface> surfaces_;
  std::vector<int> shown_;
  std::vector<std::uint16_t> depth_;  ///< [mm]
};

/// A scene whose other surface has to be told from the floor.
struct LabelCase {
  const char* name;
  std::function<Scene(double)> scene;  ///< of a share, 0 to 1, of the distances that are meant
  Label truth;                         ///< of the other surface
};
/// Floor alone first.
std::vector<LabelCase> labelCases();

/// What an image of such a scene is called, by a camera that knows its height within 15 mm.
struct LabelFigures {
  bool found = false;     ///< the floor
  std::size_t other = 0;  ///< [px] of the other surface, where the floor would be within 2.5 m
  double right = 0.0;     ///< [-] of these, with the right label
  double ground = 0.0;    ///< [-] of these, called ground
  std::size_t false_drop_off = 0;  ///< [px] of floor

  /// As for low obstacles: at least half of it is right, and at most a quarter ground.
  bool told() const { return found && right >= 0.5 && ground <= 0.25; }
};
/// @param share of `LabelCase::scene`.
LabelFigures labelFigures(const LabelCase& which, double share, ErrorKind error,
                          std::uint32_t seed);

}  // namespace dominant_plane_detection
