#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "dominant_plane_detection/parameters.h"
#include "frame_source.h"

namespace dominant_plane_detection {

/// What a command line says about depth images and the detection on them.
struct SourceArguments {
  std::vector<std::string> inputs;
  std::string topic;
  std::vector<double> camera;
  std::string camera_info;
  double depth_scale = 1000.0;
  std::string sensor;
  std::string correction;
  std::string params;
  std::vector<std::string> settings;
  std::vector<double> range;
  std::string algorithm;

  /// Later ones win, as in the launch files: --params, --sensor, --set, --range, --algorithm.
  /// @throw std::invalid_argument, std::runtime_error
  Parameters readParameters() const;
  /// @throw std::runtime_error
  SourceOptions readSourceOptions() const;
};

/// @param settings NAME=VALUE, parameters by their names; later ones win.
/// @throw std::invalid_argument
void applySettings(const std::vector<std::string>& settings, Parameters& parameters);

/// @param required whether there have to be inputs.
void declareSource(CLI::App& app, SourceArguments& arguments, bool required);

}  // namespace dominant_plane_detection
