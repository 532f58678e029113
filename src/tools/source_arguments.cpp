#include "source_arguments.h"

#include <stdexcept>

#include "calibration/depth_correction_file.h"
#include "ros/sensor_profiles.h"
#include "yaml_files.h"

namespace dominant_plane_detection {

void declareSource(CLI::App& app, SourceArguments& arguments, bool required) {
  app.add_option("inputs", arguments.inputs,
                 "PNG files, folders of PNG files, bags, .oni recordings")
      ->required(required)
      ->type_name("INPUT");
  app.add_option("--topic", arguments.topic, "depth topic, for a bag that has several");
  app.add_option("--camera", arguments.camera, "pinhole of PNG images [px]; overrides a bag's")
      ->delimiter(',')
      ->expected(4)
      ->type_name("FX,FY,CX,CY");
  app.add_option("--camera-info", arguments.camera_info, "calibration file instead of --camera")
      ->type_name("FILE")
      ->excludes("--camera");
  app.add_option("--depth-scale", arguments.depth_scale, "units per metre of 16-bit PNG images")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--sensor", arguments.sensor,
                 "profile of the depth camera's errors: generic (default), kinect_v1,\n"
                 "realsense_d4xx, xtion, or a YAML file")
      ->type_name("NAME|FILE");
  app.add_option("--correction", arguments.correction,
                 "takes away the camera's fixed error; from calibrate_floor")
      ->type_name("FILE");
  app.add_option("--params", arguments.params, "detection parameters, the nodelet's YAML")
      ->type_name("FILE");
  app.add_option("--set", arguments.settings, "one detection parameter; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  app.add_option("--range", arguments.range, "trusted depths [m]")
      ->delimiter(',')
      ->expected(2)
      ->type_name("MIN,MAX");
  app.add_option("--algorithm", arguments.algorithm, "grid (default) or kdtree")
      ->check(CLI::IsMember({"grid", "kdtree"}));
}

void applySettings(const std::vector<std::string>& settings, Parameters& parameters) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument("--set: expected NAME=VALUE, got '" + setting + "'");
    }
    setParameter(parameters, setting.substr(0, equals), setting.substr(equals + 1));
  }
}

Parameters SourceArguments::readParameters() const {
  Parameters parameters;
  if (!params.empty()) loadParameters(params, parameters);
  if (!sensor.empty()) loadParameters(findSensorProfile(sensor), parameters);
  applySettings(settings, parameters);
  if (!range.empty()) {
    parameters.range_min = range[0];
    parameters.range_max = range[1];
  }
  if (!algorithm.empty()) setParameter(parameters, "algorithm", algorithm);
  return parameters;
}

SourceOptions SourceArguments::readSourceOptions() const {
  SourceOptions source;
  source.units_per_metre = depth_scale;
  source.topic = topic;
  if (!correction.empty()) source.correction = loadDepthCorrection(correction);
  if (!camera_info.empty()) {
    source.camera = loadCamera(camera_info);
  } else if (!camera.empty()) {
    CameraModel model;  // takes the size of each image
    model.fx = camera[0];
    model.fy = camera[1];
    model.cx = camera[2];
    model.cy = camera[3];
    source.camera = model;
  }
  return source;
}

}  // namespace dominant_plane_detection
