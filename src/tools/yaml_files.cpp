#include "yaml_files.h"

#include <camera_calibration_parsers/parse.h>

#include <stdexcept>

#include "ros/camera_conversion.h"

namespace dominant_plane_detection {
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
