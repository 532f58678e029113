#pragma once

#include <yaml-cpp/yaml.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace dominant_plane_detection {

/// @param what the file is, for people, for example "a depth correction".
/// @param parse makes the result of the file's root, and throws one sentence where it cannot.
/// @throw std::runtime_error that names the file, what was expected and what came.
template <typename Parse>
auto readYaml(const std::string& file, const char* what, Parse&& parse) {
  try {
    return parse(YAML::LoadFile(file));
  } catch (const YAML::BadFile&) {
    throw std::runtime_error(file + ": expected " + what + ", got no file that can be read");
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

/// @throw std::runtime_error when the file cannot be written.
inline void writeYaml(const std::string& file, const YAML::Emitter& content) {
  std::ofstream stream(file);
  stream << content.c_str() << '\n';
  stream.close();
  if (!stream) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace dominant_plane_detection
