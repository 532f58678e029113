#pragma once

#include <string>
#include <vector>

#include "calibration/depth_pair.h"

namespace dominant_plane_detection {

/// Reads a CSV file with the header `raw,distance` or `raw,distance,sigma`, distances in metres.
/// @throw std::runtime_error that names the file, the line and what was expected.
std::vector<DepthPair> loadPairs(const std::string& file);

/// Writes a pair below those that the file has; makes the file with its header where it is missing.
/// @throw std::runtime_error when it cannot be written.
void appendPair(const std::string& file, const DepthPair& pair);

}  // namespace dominant_plane_detection
