#include "doctor_settings.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "calibration/depth_correction_file.h"
#include "ros/parameter_file.h"
#include "ros/sensor_profiles.h"

namespace dominant_plane_detection {
namespace {

bool isOneOf(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool readSwitch(const std::string& name, const std::string& value) {
  if (value == "true" || value == "1") return true;
  if (value == "false" || value == "0") return false;
  throw std::invalid_argument(name + ": expected true or false, got '" + value + "'");
}

bool readInput(const std::string& value) {
  if (value == "points") return true;
  if (value == "depth") return false;
  throw std::invalid_argument("input: expected depth or points, got '" + value + "'");
}

}  // namespace

void DoctorSettings::set(const std::string& name, const std::string& value) {
  if (name == "input") {
    points = readInput(value);
  } else if (name == "rectified") {
    rectified = readSwitch(name, value);
  } else if (name == "image_transport") {
    transport = value;
  } else if (name == "sensor") {
    if (!value.empty()) loadParameters(findSensorProfile(value), detection);
  } else if (name == "correction") {
    correction.reset();
    if (!value.empty()) correction = loadDepthCorrection(value);
  } else if (isOneOf(parameterNames<NodeParameters>(), name)) {
    setParameter(node, name, value);
  } else if (nodeletParameters().count(name) == 0) {
    setParameter(detection, name, value);
  }
}

void DoctorSettings::take(const SourceArguments& arguments) {
  const auto one = [this](const std::string& name, const std::string& value) { set(name, value); };
  if (!arguments.params.empty()) visitAllParameters(arguments.params, one);
  set("sensor", arguments.sensor);
  for (const std::string& setting : arguments.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument("--set: expected NAME=VALUE, got '" + setting + "'");
    }
    set(setting.substr(0, equals), setting.substr(equals + 1));
  }
  if (!arguments.range.empty()) {
    detection.range_min = arguments.range[0];
    detection.range_max = arguments.range[1];
  }
  if (!arguments.algorithm.empty()) set("algorithm", arguments.algorithm);
  if (!arguments.correction.empty()) set("correction", arguments.correction);
}

}  // namespace dominant_plane_detection
