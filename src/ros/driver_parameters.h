#pragma once

#include <string>
#include <vector>

#include "openni2/camera_device.h"
#include "ros/ros_parameters.h"

namespace dominant_plane_detection {

/// What can be changed about the driver while it runs.
struct DriverParameters {
  CameraSettings camera;
  double z_offset = 0.0;          ///< [m] added to each depth reading, after z_scale
  double z_scale = 1.0;           ///< [-] each depth reading is multiplied by
  double time_offset = 0.0;       ///< [s] added to each stamp
  double watchdog_timeout = 2.0;  ///< [s] without an image until its stream is started anew
};

/// The one list of the driver's parameters; see `visitParameters` of the detection. Members are of
/// type VideoMode, bool, int or double.
template <typename ParametersT, typename Visitor, IfParameters<ParametersT, DriverParameters> = 0>
void visitParameters(ParametersT& parameters, Visitor&& visit) {
  using Info = ParameterInfo;
  auto& p = parameters;
  visit(Info{"depth_mode", "px, 1/s", 0, 0, "size and rate of depth images"}, p.camera.depth_mode);
  visit(Info{"rgb_mode", "px, 1/s", 0, 0, "size and rate of colour images"}, p.camera.rgb_mode);
  visit(Info{"ir_mode", "px, 1/s", 0, 0, "size and rate of infrared images"}, p.camera.ir_mode);
  visit(Info{"depth_registration", "-", 0, 1,
             "depth as the colour camera would see it, on depth_registered instead of depth"},
        p.camera.depth_registration);
  visit(Info{"raw_disparity", "-", 0, 1,
             "depth from the sensor's raw disparity by depth_calibration, not the camera's own"},
        p.camera.raw_disparity);
  visit(Info{"auto_exposure", "-", 0, 1, "the colour camera chooses its exposure"},
        p.camera.auto_exposure);
  visit(Info{"exposure", "us", 0, 200000,
             "of the colour camera while auto_exposure is off; 0: as the camera has it"},
        p.camera.exposure);
  visit(Info{"gain", "-", 0, 65535,
             "of the colour camera while auto_exposure is off, in its own unit; 0: as it has it"},
        p.camera.gain);
  visit(Info{"auto_white_balance", "-", 0, 1, "the colour camera chooses its white balance"},
        p.camera.auto_white_balance);
  visit(Info{"repeat", "-", 0, 1, "a recording (.oni) begins again at its end"}, p.camera.repeat);
  visit(Info{"z_offset", "m", -1, 1, "added to each depth reading, after z_scale"}, p.z_offset);
  visit(Info{"z_scale", "-", 0.5, 2, "each depth reading is multiplied by this"}, p.z_scale);
  visit(Info{"time_offset", "s", -1, 1, "added to each stamp"}, p.time_offset);
  visit(Info{"watchdog_timeout", "s", 0.2, 60, "without an image until its stream is started anew"},
        p.watchdog_timeout);
}

std::vector<std::string> findErrors(const DriverParameters& parameters);
/// @throw std::invalid_argument as `setParameter` of the detection does.
void setParameter(DriverParameters& parameters, const std::string& name, const std::string& value);

inline std::string configValue(const VideoMode& mode) { return toString(mode); }

}  // namespace dominant_plane_detection
