// Prints the parameters of detection and driver as their tables have them, for
// scripts/update_parameters: a line each, of nodelet, name, type, unit, default, least, most and
// meaning, with tabs between.

#include <array>
#include <charconv>
#include <iostream>

#include "ros/driver_parameters.h"
#include "ros/node_parameters.h"

namespace dominant_plane_detection {
namespace {

template <typename Choice>
std::enable_if_t<std::is_enum_v<Choice>, const char*> typeOf(Choice) {
  return "choice";
}
const char* typeOf(const std::string&) { return "text"; }
const char* typeOf(const VideoMode&) { return "text"; }
const char* typeOf(bool) { return "bool"; }
const char* typeOf(int) { return "int"; }
const char* typeOf(double) { return "double"; }

std::string textOf(const std::string& value) { return value; }
std::string textOf(bool value) { return value ? "true" : "false"; }
std::string textOf(int value) { return std::to_string(value); }

/// As few digits as tell the number, with a point.
std::string textOf(double value) {
  std::array<char, 400> buffer;  // the longest has 325
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  const std::string digits(buffer.data(), end.ptr);
  return digits.find('.') == std::string::npos ? digits + ".0" : digits;
}

template <typename T>
std::string limitText(double limit) {
  if constexpr (kHasLimits<T>) return textOf(static_cast<T>(limit));
  return "";
}

template <typename ParametersT>
void print(const char* nodelet) {
  const ParametersT defaults;
  visitParameters(defaults, [&](const ParameterInfo& info, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    const std::array<std::string, 8> columns = {nodelet,
                                                info.name,
                                                typeOf(value),
                                                info.unit,
                                                textOf(configValue(value)),
                                                limitText<T>(info.min),
                                                limitText<T>(info.max),
                                                info.text};
    for (const std::string& column : columns) {
      std::cout << column << (&column == &columns.back() ? '\n' : '\t');
    }
  });
}

}  // namespace
}  // namespace dominant_plane_detection

int main() {
  using namespace dominant_plane_detection;
  print<DriverParameters>("OpenNI2Driver");
  print<Parameters>("PlaneDetection");
  print<NodeParameters>("PlaneDetectionNode");
}
