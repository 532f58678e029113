#include "sensor_profiles.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;

/// @return the folder that the package installs its profiles in, from where this program lies.
fs::path profilesFolder() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  return program.parent_path() / "../../share/dominant_plane_detection/config/sensors";
}

}  // namespace

std::string findSensorProfile(const std::string& sensor) {
  const fs::path by_name = profilesFolder() / (sensor + ".yaml");
  std::error_code error;
  if (fs::is_regular_file(by_name, error)) return by_name.string();
  if (fs::is_regular_file(sensor, error)) return sensor;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(profilesFolder(), error)) {
    names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  throw std::invalid_argument("--sensor: expected one of " + all + ", or a YAML file, got '" +
                              sensor + "'");
}

}  // namespace dominant_plane_detection
