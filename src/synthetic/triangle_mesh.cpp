#include "synthetic/triangle_mesh.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <cmath>
#include <stdexcept>

namespace dominant_plane_detection {
namespace {

constexpr double kPi = 3.14159265358979323846;

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

TriangleMesh ellipsoidMesh(const Eigen::Vector3d& half_axes) {
  constexpr std::uint32_t kSides = 72, kRings = 36;
  TriangleMesh mesh;
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    const double down = kPi * ring / kRings;
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const double around = 2.0 * kPi * side / kSides;
      const Eigen::Vector3d unit(std::sin(down) * std::cos(around),
                                 std::sin(down) * std::sin(around), std::cos(down));
      mesh.vertices.push_back(half_axes.cwiseProduct(unit).cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const std::uint32_t above = ring * kSides, below = above + kSides;
      const std::uint32_t next = (side + 1) % kSides;
      addQuad(mesh, above + side, below + side, below + next, above + next);
    }
  }
  return mesh;
}

TriangleMesh curtainMesh(double width, double height,
                         const std::function<double(double y, double z)>& depth) {
  constexpr double kStep = 0.01;
  const auto columns = static_cast<std::uint32_t>(std::lround(width / kStep));
  const auto rows = static_cast<std::uint32_t>(std::lround(height / kStep));
  TriangleMesh mesh;
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const double y = width * (static_cast<double>(column) / columns - 0.5);
      const double z = height * row / rows;
      mesh.vertices.push_back(Eigen::Vector3d(depth(y, z), y, z).cast<float>());
    }
  }
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t corner = row * (columns + 1) + column;
      addQuad(mesh, corner, corner + columns + 1, corner + columns + 2, corner + 1);
    }
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
