#pragma once

#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>

#include <string>

#include "support/ros_test.h"

namespace dominant_plane_detection {

/// Asks a node to change one of its parameters.
/// @param node resolved, such as "/camera/driver".
/// @return what holds then: the value, or the old one where it was refused.
template <typename Value>
Value change(const std::string& node, const std::string& name, const Value& value) {
  const std::string service = node + "/set_parameters";
  dynamic_reconfigure::Reconfigure call;
  dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, name, value);
  EXPECT_TRUE(spinUntil([&] { return ros::service::exists(service, false); })) << service;
  EXPECT_TRUE(ros::service::call(service, call)) << service;
  Value holds{};
  EXPECT_TRUE(dynamic_reconfigure::ConfigTools::getParameter(call.response.config, name, holds))
      << name;
  return holds;
}

}  // namespace dominant_plane_detection
