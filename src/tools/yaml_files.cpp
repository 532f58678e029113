#include "yaml_files.h"

#include <camera_calibration_parsers/parse.h>
#include <yaml-cpp/yaml.h>

#include <stdexcept>

#include "ros/camera_conversion.h"

namespace dominant_plane_detection {
namespace {

/// Of the nodelet, not of the detection; its YAML may hold them.
bool isNodeletParameter(const std::string& name) { return name == "input" || name == "rectified"; }

}  // namespace

void loadParameters(const std::string& file, Parameters& parameters) {
  try {
    const YAML::Node root = YAML::LoadFile(file);
    if (!root.IsMap() && !root.IsNull()) {
      throw std::invalid_argument("expected lines of the form NAME: VALUE");
    }
    for (const auto& entry : root) {
      const auto name = entry.first.as<std::string>();
      if (isNodeletParameter(name)) continue;
      setParameter(parameters, name, entry.second.IsScalar() ? entry.second.Scalar() : "");
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

CameraModel loadCamera(const std::string& file) {
  std::string name;
  sensor_msgs::CameraInfo info;
  if (!camera_calibration_parsers::readCalibration(file, name, info)) {
    throw std::runtime_error(file +
                             ": expected a calibration file as camera_calibration writes it");
  }
  std::string error;
  const auto camera = cameraModel(info, false, error);
  if (!camera) throw std::runtime_error(file + ": " + error);
  return *camera;
}

}  // namespace dominant_plane_detection
