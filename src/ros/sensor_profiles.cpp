#include "ros/sensor_profiles.h"

#include <ros/package.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;

/// @return the folder of the profiles: beside an installed program, which needs no ROS environment
/// then, or where ROS finds the package.
fs::path profilesFolder() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  fs::path folder = program.parent_path() / "../../share/dominant_plane_detection/config/sensors";
  std::error_code error;
  if (fs::is_directory(folder, error)) return folder;
  return fs::path(ros::package::getPath("dominant_plane_detection")) / "config/sensors";
}

}  // namespace

std::string findSensorProfile(const std::string& sensor) {
  const fs::path folder = profilesFolder();
  const fs::path by_name = folder / (sensor + ".yaml");
  std::error_code error;
  if (fs::is_regular_file(by_name, error)) return by_name.string();
  if (fs::is_regular_file(sensor, error)) return sensor;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  throw std::invalid_argument("sensor: expected one of " + all + ", or a YAML file, got '" +
                              sensor + "'");
}

}  // namespace dominant_plane_detection
