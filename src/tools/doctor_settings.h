#pragma once

#include <optional>
#include <string>

#include "dominant_plane_detection/depth_correction.h"
#include "dominant_plane_detection/parameters.h"
#include "ros/node_parameters.h"
#include "source_arguments.h"

namespace dominant_plane_detection {

/// What a detection nodelet would be told.
struct DoctorSettings {
  Parameters detection;
  NodeParameters node;
  bool points = false;     ///< the parameter `input`
  bool rectified = false;  ///< P of camera_info holds
  std::string transport = "raw";
  std::optional<DepthCorrection> correction;

  /// @throw std::invalid_argument for a name that neither has, or a text that is no value;
  /// std::runtime_error for a file that cannot be read.
  void set(const std::string& name, const std::string& value);
  /// What a command line says, over what is there, in the order of `SourceArguments`.
  /// @throw std::invalid_argument, std::runtime_error
  void take(const SourceArguments& arguments);
};

}  // namespace dominant_plane_detection
