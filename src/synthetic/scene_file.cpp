#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <initializer_list>
#include <set>
#include <stdexcept>

#include "synthetic/scene.h"

namespace dominant_plane_detection {
namespace {

/// Something wrong at a place of the file.
[[noreturn]] void fail(const YAML::Node& node, const std::string& what) {
  throw std::runtime_error("line " + std::to_string(node.Mark().line + 1) + ": " + what);
}

void allowKeys(const YAML::Node& node, const std::string& where,
               const std::set<std::string>& allowed) {
  if (!node.IsMap()) fail(node, "expected keys and values in " + where);
  std::string names;
  for (const std::string& name : allowed) names += (names.empty() ? "" : ", ") + name;
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    if (allowed.count(key) == 0) {
      fail(entry.first, "there is no '" + key + "' in " + where + ", but " + names);
    }
  }
}

template <typename T>
T read(const YAML::Node& node, const char* key, const char* expected) {
  const YAML::Node value = node[key];
  if (!value) fail(node, std::string("'") + key + "' is missing, expected " + expected);
  try {
    return value.as<T>();
  } catch (const YAML::Exception&) {
    fail(value, std::string("'") + key + "': expected " + expected);
  }
}

template <typename T>
T read(const YAML::Node& node, const char* key, const char* expected, const T& otherwise) {
  return node[key] ? read<T>(node, key, expected) : otherwise;
}

Eigen::Vector3d readVector(const YAML::Node& node, const char* key, const char* expected,
                           const Eigen::Vector3d& otherwise) {
  if (!node[key]) return otherwise;
  const auto values = read<std::vector<double>>(node, key, expected);
  if (values.size() != 3) fail(node[key], std::string("'") + key + "': expected " + expected);
  return {values[0], values[1], values[2]};
}

constexpr const char* kSize = "[length, width, height] in m, all positive";

Eigen::Vector3d readSize(const YAML::Node& node) {
  const Eigen::Vector3d size = readVector(node, "size", kSize, Eigen::Vector3d::Zero());
  if (!(size.minCoeff() > 0.0)) fail(node, std::string("'size': expected ") + kSize);
  return size;
}

TriangleMesh readMesh(const YAML::Node& node, const std::filesystem::path& folder) {
  const auto shape =
      read<std::string>(node, "shape", "floor, ramp, step, wall, box, cylinder or mesh");
  if (shape == "floor") {
    const auto size = read<std::vector<double>>(node, "size", "[length, width] in m", {20.0, 20.0});
    if (size.size() != 2) fail(node["size"], "'size': expected [length, width] in m");
    return rectangleMesh(size[0], size[1]);
  }
  if (shape == "box" || shape == "step" || shape == "wall") return boxMesh(readSize(node));
  if (shape == "ramp") return rampMesh(readSize(node));
  if (shape == "cylinder") {
    return cylinderMesh(read<double>(node, "radius", "a number in m"),
                        read<double>(node, "height", "a number in m"));
  }
  if (shape == "mesh")
    return loadObj((folder / read<std::string>(node, "file", "an OBJ file")).string());
  fail(node["shape"],
       "there is no shape '" + shape + "', but floor, ramp, step, wall, box, cylinder and mesh");
}

SceneObject readObject(const YAML::Node& node, const std::filesystem::path& folder) {
  allowKeys(node, "an object",
            {"shape", "position", "yaw", "size", "radius", "height", "file", "colour", "tiles",
             "ground"});
  SceneObject object;
  object.mesh = readMesh(node, folder);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = readVector(node, "position", "[x, y, z] in m", Eigen::Vector3d::Zero());
  pose.rotate(Eigen::AngleAxisd(read<double>(node, "yaw", "an angle in rad", 0.0),
                                Eigen::Vector3d::UnitZ()));
  object.mesh.transform(pose);
  object.colour = readVector(node, "colour", "[red, green, blue] of 0 to 1", object.colour);
  object.tiles = read<double>(node, "tiles", "a number in m", 0.0);
  object.ground = read<bool>(node, "ground", "true or false", false);
  if (object.ground && pose.translation().z() != 0.0) {
    fail(node, "the ground is the plane z = 0, its position has to have z = 0");
  }
  return object;
}

KeyPose readKey(const YAML::Node& node) {
  allowKeys(node, "a key pose of the path", {"time", "position", "roll", "pitch", "yaw"});
  KeyPose key;
  key.time = read<double>(node, "time", "a number in s");
  key.position = readVector(node, "position", "[x, y, z] in m", key.position);
  key.roll = read<double>(node, "roll", "an angle in rad", 0.0);
  key.pitch = read<double>(node, "pitch", "an angle in rad", 0.0);
  key.yaw = read<double>(node, "yaw", "an angle in rad", 0.0);
  return key;
}

CameraModel readCamera(const YAML::Node& node) {
  allowKeys(node, "camera", {"width", "height", "fx", "fy", "cx", "cy"});
  CameraModel camera;
  camera.width = read<int>(node, "width", "a whole number of px");
  camera.height = read<int>(node, "height", "a whole number of px");
  camera.fx = read<double>(node, "fx", "a number in px");
  camera.fy = read<double>(node, "fy", "a number in px");
  camera.cx = read<double>(node, "cx", "a number in px");
  camera.cy = read<double>(node, "cy", "a number in px");
  if (!camera.valid()) fail(node, "expected a camera with positive size and focal lengths");
  return camera;
}

SensorNoise readSensor(const YAML::Node& node) {
  const auto name = read<std::string>(node, "sensor", "a sensor's name", std::string("kinect"));
  try {
    return SensorNoise::named(name);
  } catch (const std::invalid_argument& error) {
    fail(node["sensor"], error.what());
  }
}

SensorNoise readNoise(const YAML::Node& node) {
  allowKeys(node, "noise",
            {"sensor", "axial", "noise_constant", "noise_quadratic", "smooth", "quantise",
             "shadows", "drop_out", "min_cosine", "range_min", "range_max"});
  SensorNoise noise = readSensor(node);
  noise.axial = read(node, "axial", "true or false", noise.axial);
  noise.model.constant = read(node, "noise_constant", "a number in m", noise.model.constant);
  noise.model.quadratic = read(node, "noise_quadratic", "a number in 1/m", noise.model.quadratic);
  noise.smooth = read(node, "smooth", "true or false", noise.smooth);
  noise.quantise = read(node, "quantise", "true or false", noise.quantise);
  noise.shadows = read(node, "shadows", "true or false", noise.shadows);
  noise.drop_out = read(node, "drop_out", "a share of 0 to 1", noise.drop_out);
  noise.min_cosine = read(node, "min_cosine", "a number of 0 to 1", noise.min_cosine);
  noise.range_min = read(node, "range_min", "a number in m", noise.range_min);
  noise.range_max = read(node, "range_max", "a number in m", noise.range_max);
  return noise;
}

Scene readScene(const YAML::Node& root, const std::filesystem::path& folder) {
  allowKeys(root, "a scene", {"objects", "camera", "path", "noise"});
  Scene scene;
  scene.camera = root["camera"] ? readCamera(root["camera"]) : kinectCamera();
  if (root["noise"]) scene.noise = readNoise(root["noise"]);
  for (const YAML::Node& node : root["objects"]) scene.objects.push_back(readObject(node, folder));
  if (scene.objects.empty()) fail(root, "'objects' is missing, expected a list of them");
  for (const YAML::Node& node : root["path"]) {
    const KeyPose key = readKey(node);
    if (!scene.path.keys.empty() && key.time <= scene.path.keys.back().time) {
      fail(node, "'time': expected a later time than that of the key pose before");
    }
    scene.path.keys.push_back(key);
  }
  if (scene.path.keys.empty()) fail(root, "'path' is missing, expected a list of key poses");
  return scene;
}

}  // namespace

Scene loadScene(const std::string& file) {
  try {
    return readScene(YAML::LoadFile(file), std::filesystem::path(file).parent_path());
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

}  // namespace dominant_plane_detection
