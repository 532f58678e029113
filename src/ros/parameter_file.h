#pragma once

#include <functional>
#include <set>
#include <string>

#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// Reads detection parameters from the nodelet's YAML file; what it does not name stays.
/// @throw std::runtime_error that names the file and what is wrong in it.
void loadParameters(const std::string& file, Parameters& parameters);

/// Calls visit(name, text) for each line of such a file that is the detection's.
/// @throw std::runtime_error, also for what `visit` throws.
void visitParameterFile(
    const std::string& file,
    const std::function<void(const std::string& name, const std::string& value)>& visit);

/// The same, with the lines that are the nodelet's own; the text of a list is empty.
void visitAllParameters(
    const std::string& file,
    const std::function<void(const std::string& name, const std::string& value)>& visit);

/// @return the names of parameters that are the nodelet's own.
const std::set<std::string>& nodeletParameters();

}  // namespace dominant_plane_detection
