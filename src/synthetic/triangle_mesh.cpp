#include "synthetic/triangle_mesh.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <cmath>
#include <stdexcept>

namespace dominant_plane_detection {
namespace {

void addQuad(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
             std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// A body with a bottom 0 1 2 3 and a top 4 5 6 7, both counter-clockwise seen from above.
void addSides(TriangleMesh& mesh) {
  addQuad(mesh, 3, 2, 1, 0);
  addQuad(mesh, 4, 5, 6, 7);
  for (std::uint32_t i = 0; i < 4; ++i) addQuad(mesh, i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i);
}

}  // namespace

void TriangleMesh::transform(const Eigen::Isometry3d& pose) {
  for (Eigen::Vector3f& vertex : vertices) vertex = (pose * vertex.cast<double>()).cast<float>();
}

TriangleMesh rectangleMesh(double length, double width) {
  const auto x = static_cast<float>(length / 2.0);
  const auto y = static_cast<float>(width / 2.0);
  TriangleMesh mesh;
  mesh.vertices = {{-x, -y, 0.0F}, {x, -y, 0.0F}, {x, y, 0.0F}, {-x, y, 0.0F}};
  addQuad(mesh, 0, 1, 2, 3);
  return mesh;
}

TriangleMesh boxMesh(const Eigen::Vector3d& size) {
  TriangleMesh mesh = rectangleMesh(size.x(), size.y());
  const std::vector<Eigen::Vector3f> bottom = mesh.vertices;
  for (const Eigen::Vector3f& corner : bottom) {
    mesh.vertices.emplace_back(corner.x(), corner.y(), static_cast<float>(size.z()));
  }
  mesh.triangles.clear();
  addSides(mesh);
  return mesh;
}

TriangleMesh rampMesh(const Eigen::Vector3d& size) {
  TriangleMesh mesh = boxMesh(size);
  for (std::size_t i = 4; i < 8; ++i) {
    if (mesh.vertices[i].x() < 0.0F) mesh.vertices[i].z() = 0.0F;
  }
  return mesh;
}

TriangleMesh cylinderMesh(double radius, double height) {
  constexpr std::uint32_t kSides = 72;
  constexpr double kPi = 3.14159265358979323846;
  TriangleMesh mesh;
  const auto top = static_cast<float>(height);
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2.0 * kPi * i / kSides;
    const auto x = static_cast<float>(radius * std::cos(angle));
    const auto y = static_cast<float>(radius * std::sin(angle));
    mesh.vertices.emplace_back(x, y, 0.0F);
    mesh.vertices.emplace_back(x, y, top);
  }
  mesh.vertices.emplace_back(0.0F, 0.0F, top);
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t next = (i + 1) % kSides;
    addQuad(mesh, 2 * i, 2 * next, 2 * next + 1, 2 * i + 1);
    mesh.triangles.push_back({2 * i + 1, 2 * next + 1, 2 * kSides});
  }
  return mesh;
}

TriangleMesh loadObj(const std::string& file) {
  tinyobj::ObjReader reader;
  tinyobj::ObjReaderConfig config;
  config.triangulate = true;
  if (!reader.ParseFromFile(file, config)) {
    throw std::runtime_error(file + ": expected a Wavefront OBJ file" +
                             (reader.Error().empty() ? "" : ", " + reader.Error()));
  }
  TriangleMesh mesh;
  const auto& coordinates = reader.GetAttrib().vertices;
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    mesh.vertices.emplace_back(static_cast<float>(coordinates[i]),
                               static_cast<float>(coordinates[i + 1]),
                               static_cast<float>(coordinates[i + 2]));
  }
  for (const auto& shape : reader.GetShapes()) {
    const auto& indices = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      mesh.triangles.push_back({static_cast<std::uint32_t>(indices[i].vertex_index),
                                static_cast<std::uint32_t>(indices[i + 1].vertex_index),
                                static_cast<std::uint32_t>(indices[i + 2].vertex_index)});
    }
  }
  if (mesh.triangles.empty()) throw std::runtime_error(file + ": there are no triangles in it");
  return mesh;
}

}  // namespace dominant_plane_detection
