#include "ros/parameter_file.h"

#include <yaml-cpp/yaml.h>

#include <stdexcept>

#include "ros/node_parameters.h"

namespace dominant_plane_detection {

const std::set<std::string>& nodeletParameters() {
  static const std::set<std::string> all = [] {
    std::set<std::string> names{"correction", "image_transport", "input", "learn_correction",
                                "rectified",  "robot_body",      "sensor"};
    for (const std::string& name : parameterNames<NodeParameters>()) names.insert(name);
    return names;
  }();
  return all;
}

void visitAllParameters(
    const std::string& file,
    const std::function<void(const std::string& name, const std::string& value)>& visit) {
  try {
    const YAML::Node root = YAML::LoadFile(file);
    if (!root.IsMap() && !root.IsNull()) {
      throw std::invalid_argument("expected lines of the form NAME: VALUE");
    }
    for (const auto& entry : root) {
      const auto name = entry.first.as<std::string>();
      visit(name, entry.second.IsScalar() ? entry.second.Scalar() : "");
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

void visitParameterFile(
    const std::string& file,
    const std::function<void(const std::string& name, const std::string& value)>& visit) {
  visitAllParameters(file, [&](const std::string& name, const std::string& value) {
    if (nodeletParameters().count(name) == 0) visit(name, value);
  });
}

void loadParameters(const std::string& file, Parameters& parameters) {
  visitParameterFile(file, [&](const std::string& name, const std::string& value) {
    setParameter(parameters, name, value);
  });
}

}  // namespace dominant_plane_detection
