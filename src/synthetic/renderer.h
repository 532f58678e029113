#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "dominant_plane_detection/camera_model.h"
#include "synthetic/scene.h"

namespace dominant_plane_detection {

/// What a perfect camera sees of a scene, and what is true about it. One value a pixel, row-major.
struct Rendering {
  int width = 0;              ///< [px]
  int height = 0;             ///< [px]
  double focal_length = 0.0;  ///< [px]
  std::vector<float> depth;   ///< [m] along the optical axis, 0 where nothing is seen
  std::vector<float> cosine;  ///< [-] of the angle between ray and surface normal
  std::vector<std::uint8_t>
      shadow;  ///< 1 where the projector does not shine; empty if not asked for
  std::vector<std::uint8_t> labels;  ///< `Label`; kUnknown where nothing is seen
  std::vector<std::uint8_t> colour;  ///< red, green, blue; empty if not asked for
  /// [-] unit normals of the surfaces, towards the camera, in the optical frame; 0 where nothing is
  /// seen, empty if not asked for
  std::vector<Eigen::Vector3f> surface_normals;

  /// The ground z = 0 in the optical frame: normal . r + distance = 0, towards the camera.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double distance = 0.0;  ///< [m]
};

/// What is rendered beside depth, incidence and labels.
struct Layers {
  bool shadow = false;
  bool colour = false;
  bool surface_normals = false;
};

/// Casts rays into a scene (Embree: the ray casting library that Debian has).
class Renderer {
 public:
  /// Copies what it needs of the scene.
  explicit Renderer(const Scene& scene);
  ~Renderer();

  /// @param pose T_world_camera of the optical frame.
  Rendering render(const Eigen::Isometry3d& pose, const Layers& layers) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace dominant_plane_detection
