#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dominant_plane_detection {

/// Triangles with common corners, counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;                ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of vertices

  void transform(const Eigen::Isometry3d& pose);
};

/// Shapes about the origin, z up. Sizes in [m].
TriangleMesh rectangleMesh(double length, double width);  ///< in the plane z = 0
/// Stands on z = 0.
TriangleMesh boxMesh(const Eigen::Vector3d& size);
/// Stands on z = 0 and rises along x from 0 to `size.z()`.
TriangleMesh rampMesh(const Eigen::Vector3d& size);
/// Stands on z = 0; a prism of 72 sides.
TriangleMesh cylinderMesh(double radius, double height);
/// About the origin, with these half axes; facets of at most 5 degrees.
TriangleMesh ellipsoidMesh(const Eigen::Vector3d& half_axes);
/// Hangs in the plane x = 0 with its lower edge on z = 0, and faces both ways.
/// @param depth [m] how far the sheet lies along x at (y, z); sampled every centimetre.
TriangleMesh curtainMesh(double width, double height,
                         const std::function<double(double y, double z)>& depth);
/// @throw std::runtime_error for a Wavefront OBJ file that cannot be read.
TriangleMesh loadObj(const std::string& file);

}  // namespace dominant_plane_detection
