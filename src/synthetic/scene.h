#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "dominant_plane_detection/camera_model.h"
#include "synthetic/camera_path.h"
#include "synthetic/sensor_noise.h"
#include "synthetic/triangle_mesh.h"

namespace dominant_plane_detection {

/// Something to be seen.
struct SceneObject {
  TriangleMesh mesh;                      ///< [m] in the world
  bool ground = false;                    ///< part of the plane z = 0 that is the ground
  Eigen::Vector3d colour{0.6, 0.6, 0.6};  ///< [-] red, green, blue, 0 to 1
  double tiles = 0.0;                     ///< [m] side of a chequered pattern; 0: plain
};

/// Objects in a world with x forward, y left, z up; a camera that moves through it. The ground is
/// the plane z = 0; other objects do not have faces in it.
struct Scene {
  std::vector<SceneObject> objects;
  CameraModel camera;
  CameraPath path;
  SensorNoise noise;

  /// @param pose T_world_mesh.
  /// @return the object, for what else is to be said of it; until the next one is added.
  SceneObject& add(TriangleMesh mesh, const Eigen::Isometry3d& pose);
};

/// Reads a scene description; scenes/ has examples with all that can stand in one.
/// @throw std::runtime_error with file, line, what was expected and what came.
Scene loadScene(const std::string& file);

/// A Kinect's 640 x 480 pinhole.
CameraModel kinectCamera();

}  // namespace dominant_plane_detection
