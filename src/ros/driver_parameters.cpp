#include "ros/driver_parameters.h"

#include "core/parameter_text.h"

namespace dominant_plane_detection {

void parseValue(const ParameterInfo& info, const std::string& text, VideoMode& value) {
  const auto mode = parseVideoMode(text);
  if (!mode) {
    throw std::invalid_argument(std::string(info.name) +
                                ": expected WIDTHxHEIGHT@RATE such as 640x480@30, got '" + text +
                                "'");
  }
  value = *mode;
}

std::vector<std::string> findErrors(const DriverParameters& parameters) {
  std::vector<std::string> errors = findRangeErrors(parameters);
  if (parameters.camera.raw_disparity && parameters.camera.depth_registration) {
    errors.emplace_back(
        "raw_disparity and depth_registration: expected one of them at most, a camera registers "
        "its own depth only");
  }
  return errors;
}

void setParameter(DriverParameters& parameters, const std::string& name, const std::string& value) {
  setByName(parameters, name, value);
}

}  // namespace dominant_plane_detection
