#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/config_tools.h>
#include <ros/console.h>
#include <ros/node_handle.h>

#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "core/parameter_table.h"

namespace dominant_plane_detection {

// Parameters of a node, any set of them that has `visitParameters`, `findErrors` and
// `setParameter`, and its `Config`, the same as dynamic_reconfigure has it.

/// @return the sentences as one line.
std::string joined(const std::vector<std::string>& sentences);

/// @return a value of the parameter server as the text that `setParameter` reads; empty for a list
/// or a structure.
std::string asText(const XmlRpc::XmlRpcValue& value);

/// Points out names in a namespace that have no effect.
/// @param names of all parameters.
/// @param others names in the namespace that are somebody else's.
void warnOfUnknownNames(const ros::NodeHandle& node, const std::vector<std::string>& names,
                        const std::set<std::string>& others);

/// @return the parameters' names, in the table's order.
template <typename ParametersT>
std::vector<std::string> parameterNames() {
  std::vector<std::string> names;
  const ParametersT defaults;
  visitParameters(defaults,
                  [&](const ParameterInfo& info, const auto&) { names.push_back(info.name); });
  return names;
}

/// What dynamic_reconfigure has for a value: itself, or else a text, as for an enumeration.
template <typename T, std::enable_if_t<!std::is_enum_v<T>, int> = 0>
const T& configValue(const T& value) {
  return value;
}
template <typename Choice, std::enable_if_t<std::is_enum_v<Choice>, int> = 0>
std::string configValue(Choice value) {
  return kChoiceNames<Choice>[static_cast<std::size_t>(value)];
}

/// The same values as dynamic_reconfigure has them.
template <typename Config, typename ParametersT>
Config toConfig(const ParametersT& parameters) {
  dynamic_reconfigure::Config message;
  visitParameters(parameters, [&](const ParameterInfo& info, const auto& value) {
    dynamic_reconfigure::ConfigTools::appendParameter(message, info.name, configValue(value));
  });
  Config config = Config::__getDefault__();
  config.__fromMessage__(message);
  return config;
}

/// And back.
template <typename ParametersT, typename Config>
ParametersT fromConfig(const Config& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  ParametersT parameters;
  visitParameters(parameters, [&](const ParameterInfo& info, auto& value) {
    using Value = std::decay_t<decltype(configValue(value))>;
    Value received{};
    dynamic_reconfigure::ConfigTools::getParameter(message, info.name, received);
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Value>) {
      value = received;
    } else {
      setParameter(parameters, info.name, received);
    }
  });
  return parameters;
}

/// Takes each value that can be used on its own.
template <typename ParametersT>
std::vector<std::string> readValues(const ros::NodeHandle& node, ParametersT& parameters) {
  std::vector<std::string> errors;
  for (const std::string& name : parameterNames<ParametersT>()) {
    XmlRpc::XmlRpcValue value;
    if (!node.getParam(name, value)) continue;
    ParametersT candidate;
    try {
      setParameter(candidate, name, asText(value));
      for (const std::string& error : findErrors(candidate)) {
        // Only what is wrong with the value itself; combinations are looked at together.
        if (error.rfind(name + ": ", 0) == 0) throw std::invalid_argument(error);
      }
      setParameter(parameters, name, asText(value));
    } catch (const std::invalid_argument& error) {
      errors.emplace_back(error.what());
    }
  }
  return errors;
}

/// Reads the parameters of a namespace. Values that cannot be used are refused, all of them in one
/// line of the log, and their defaults stay; names that do not exist are pointed out. What was
/// accepted is written back, for dynamic_reconfigure to start from.
/// @param others names in the namespace that are no parameters of the set.
template <typename ParametersT, typename Config>
ParametersT loadParameters(const ros::NodeHandle& node, const std::set<std::string>& others) {
  warnOfUnknownNames(node, parameterNames<ParametersT>(), others);
  ParametersT parameters;
  std::vector<std::string> errors = readValues(node, parameters);
  const std::vector<std::string> combinations = findErrors(parameters);
  if (!combinations.empty()) {
    errors.push_back(joined(combinations) + " (all parameters back to their defaults)");
    parameters = ParametersT();
  }
  if (!errors.empty()) {
    ROS_ERROR_STREAM("Refused parameters of " << node.getNamespace()
                                              << ", their defaults are used: " << joined(errors));
  }
  toConfig<Config>(parameters).__toServer__(node);
  return parameters;
}

}  // namespace dominant_plane_detection
