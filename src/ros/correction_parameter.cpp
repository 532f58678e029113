#include "ros/correction_parameter.h"

#include <ros/console.h>

#include <stdexcept>
#include <string>

#include "calibration/depth_correction_file.h"

namespace dominant_plane_detection {

std::optional<DepthCorrection> readCorrection(const ros::NodeHandle& node) {
  const std::string file = node.param<std::string>("correction", "");
  if (file.empty()) return std::nullopt;
  try {
    return loadDepthCorrection(file);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_STREAM("Refused " << node.resolveName("correction")
                                << ", depth is not corrected: " << error.what());
    return std::nullopt;
  }
}

}  // namespace dominant_plane_detection
