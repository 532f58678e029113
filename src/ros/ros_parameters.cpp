#include "ros/ros_parameters.h"

#include <sstream>

namespace dominant_plane_detection {

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

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
    case Value::TypeBoolean:
      return static_cast<bool>(copy) ? "true" : "false";
    case Value::TypeString:
      return static_cast<std::string>(copy);
    default:
      return "";
  }
}

void warnOfUnknownNames(const ros::NodeHandle& node, const std::vector<std::string>& names,
                        const std::set<std::string>& others) {
  XmlRpc::XmlRpcValue all;
  if (!node.getParam(node.getNamespace(), all) ||
      all.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return;
  }
  std::set<std::string> known = others;
  std::string list;
  for (const std::string& name : names) {
    known.insert(name);
    list += (list.empty() ? "" : ", ") + name;
  }
  for (const auto& [name, value] : all) {
    // A namespace below this one, such as a transport's, is somebody else's.
    if (value.getType() == XmlRpc::XmlRpcValue::TypeStruct || known.count(name) != 0) continue;
    ROS_WARN_STREAM("There is no parameter " << node.getNamespace() << "/" << name
                                             << ", it has no effect. There are " << list << ".");
  }
}

}  // namespace dominant_plane_detection
