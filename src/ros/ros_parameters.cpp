#include "ros/ros_parameters.h"

#include <ros/console.h>

#include <stdexcept>
#include <vector>

#include "dominant_plane_detection/parameter_table.h"

namespace dominant_plane_detection {
namespace {

/// @return the value as the text that `setParameter` reads; empty for a list or a structure.
std::string asText(const XmlRpc::XmlRpcValue& value) {
  using Value = XmlRpc::XmlRpcValue;
  Value copy = value;  // its conversions are not const
  switch (value.getType()) {
    case Value::TypeInt:
      return std::to_string(static_cast<int>(copy));
    case Value::TypeDouble: {
      std::ostringstream text;
      text.precision(17);
      text << static_cast<double>(copy);
      return text.str();
    }
    case Value::TypeString:
      return static_cast<std::string>(copy);
    default:
      return "";
  }
}

void refuse(std::string& errors, const std::string& error) {
  errors += (errors.empty() ? "" : "; ") + error;
}

/// Takes each value that can be used on its own.
std::string readValues(const ros::NodeHandle& node, Parameters& parameters) {
  std::string errors;
  const Parameters defaults;
  visitParameters(defaults, [&](const ParameterInfo& info, const auto&) {
    XmlRpc::XmlRpcValue value;
    if (!node.getParam(info.name, value)) return;
    Parameters candidate;
    try {
      setParameter(candidate, info.name, asText(value));
      for (const std::string& error : findErrors(candidate)) {
        // Only what is wrong with the value itself; combinations are looked at together.
        if (error.rfind(std::string(info.name) + ": ", 0) == 0) throw std::invalid_argument(error);
      }
      setParameter(parameters, info.name, asText(value));
    } catch (const std::invalid_argument& error) {
      refuse(errors, error.what());
    }
  });
  return errors;
}

void warnOfUnknownNames(const ros::NodeHandle& node, const std::set<std::string>& others) {
  std::set<std::string> known = others;
  std::string names;
  const Parameters defaults;
  visitParameters(defaults, [&](const ParameterInfo& info, const auto&) {
    known.insert(info.name);
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  });
  XmlRpc::XmlRpcValue all;
  if (!node.getParam(node.getNamespace(), all) ||
      all.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return;
  }
  for (const auto& [name, value] : all) {
    // A namespace below this one, such as a transport's, is somebody else's.
    if (value.getType() == XmlRpc::XmlRpcValue::TypeStruct || known.count(name) != 0) continue;
    ROS_WARN_STREAM("There is no parameter " << node.getNamespace() << "/" << name
                                             << ", it has no effect. There are " << names << ".");
  }
}

}  // namespace

std::string describeErrors(const Parameters& parameters) {
  std::string text;
  for (const std::string& error : findErrors(parameters)) refuse(text, error);
  return text;
}

Parameters loadParameters(const ros::NodeHandle& node, const std::set<std::string>& others) {
  warnOfUnknownNames(node, others);
  Parameters parameters;
  std::string errors = readValues(node, parameters);
  const std::string combinations = describeErrors(parameters);
  if (!combinations.empty()) {
    refuse(errors, combinations + " (all parameters back to their defaults)");
    parameters = Parameters();
  }
  if (!errors.empty()) {
    ROS_ERROR_STREAM("Refused parameters of " << node.getNamespace()
                                              << ", their defaults are used: " << errors);
  }
  toConfig(parameters).__toServer__(node);
  return parameters;
}

PlaneDetectionConfig toConfig(const Parameters& parameters) {
  PlaneDetectionConfig config = PlaneDetectionConfig::__getDefault__();
  dynamic_reconfigure::Config message;
  visitParameters(parameters, [&](const ParameterInfo& info, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, Algorithm>) {
      dynamic_reconfigure::ConfigTools::appendParameter(
          message, info.name, std::string(value == Algorithm::kGrid ? "grid" : "kdtree"));
    } else {
      dynamic_reconfigure::ConfigTools::appendParameter(message, info.name, value);
    }
  });
  config.__fromMessage__(message);
  return config;
}

Parameters fromConfig(const PlaneDetectionConfig& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  Parameters parameters;
  visitParameters(parameters, [&](const ParameterInfo& info, auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, Algorithm>) {
      std::string name;
      dynamic_reconfigure::ConfigTools::getParameter(message, info.name, name);
      value = name == "kdtree" ? Algorithm::kKdtree : Algorithm::kGrid;
    } else {
      dynamic_reconfigure::ConfigTools::getParameter(message, info.name, value);
    }
  });
  return parameters;
}

}  // namespace dominant_plane_detection
