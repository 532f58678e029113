#include "virtual_kinect/virtual_uri.h"

#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

namespace dominant_plane_detection::virtual_kinect {
namespace {

double number(const std::string& name, const std::string& text) {
  std::istringstream stream(text);
  double value = 0.0;
  if (!(stream >> value) || !stream.eof()) {
    throw std::invalid_argument(name + ": expected a number, got '" + text + "'");
  }
  return value;
}

void setOption(VirtualUri& uri, const std::string& name, const std::string& value) {
  const std::map<std::string, double*> numbers = {{"start", &uri.start},   {"drift", &uri.drift},
                                                  {"unplug", &uri.unplug}, {"replug", &uri.replug},
                                                  {"stall", &uri.stall},   {"sent", &uri.sent},
                                                  {"slow", &uri.slow}};
  const auto found = numbers.find(name);
  if (found != numbers.end()) {
    *found->second = number(name, value);
  } else if (name == "serial") {
    uri.serial = value;
  } else if (name == "sensor") {
    uri.sensor = value;
  } else if (name == "noise") {
    uri.noise = number(name, value) != 0.0;
  } else if (name == "registers") {
    uri.registers = number(name, value) != 0.0;
  } else {
    throw std::invalid_argument(
        "there is no option '" + name +
        "'; there are serial, sensor, noise, start, drift, unplug, replug, stall, sent, slow, "
        "registers");
  }
}

}  // namespace

VirtualUri parseUri(const std::string& uri, const std::string& scenes) {
  VirtualUri result;
  const std::string text = uri.substr(std::strlen(kScheme));
  const std::size_t question = text.find('?');
  result.scene = text.substr(0, question);
  if (result.scene.find('/') == std::string::npos) {
    std::filesystem::path file = std::filesystem::path(scenes) / result.scene;
    if (file.extension() != ".yaml") file += ".yaml";
    result.scene = file.string();
  }
  if (question == std::string::npos) return result;
  std::istringstream options(text.substr(question + 1));
  for (std::string option; std::getline(options, option, '&');) {
    const std::size_t equals = option.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument("expected name=value, got '" + option + "'");
    }
    setOption(result, option.substr(0, equals), option.substr(equals + 1));
  }
  return result;
}

}  // namespace dominant_plane_detection::virtual_kinect
