#include "dominant_plane_detection/parameters.h"

#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "dominant_plane_detection/parameter_table.h"

namespace dominant_plane_detection {
namespace {

std::string sentence(const ParameterInfo& info, double value) {
  std::ostringstream text;
  text << info.name << ": expected " << info.min << " to " << info.max << " " << info.unit
       << ", got " << value;
  return text.str();
}

template <typename T>
void parse(const ParameterInfo& info, const std::string& text, T& value) {
  T parsed{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, parsed);
  if (error != std::errc() || stop != end) {
    throw std::invalid_argument(std::string(info.name) + ": expected " +
                                (std::is_integral_v<T> ? "a whole number" : "a number") + " [" +
                                info.unit + "], got '" + text + "'");
  }
  value = parsed;
}

void parse(const ParameterInfo& info, const std::string& text, Algorithm& value) {
  if (text == "grid") {
    value = Algorithm::kGrid;
  } else if (text == "kdtree") {
    value = Algorithm::kKdtree;
  } else {
    throw std::invalid_argument(std::string(info.name) + ": expected grid or kdtree, got '" + text +
                                "'");
  }
}

}  // namespace

std::vector<std::string> findErrors(const Parameters& p) {
  std::vector<std::string> errors;
  visitParameters(p, [&](const ParameterInfo& info, const auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
      const double number = value;
      // Written so that NaN is refused.
      if (!(info.min <= number && number <= info.max)) errors.push_back(sentence(info, number));
    }
  });
  const auto require_ascending = [&](const char* low_name, double low, const char* high_name,
                                     double high) {
    if (low < high) return;
    std::ostringstream text;
    text << low_name << " has to be smaller than " << high_name << ", got " << low << " m and "
         << high << " m";
    errors.push_back(text.str());
  };
  require_ascending("range_min", p.range_min, "range_max", p.range_max);
  require_ascending("min_height", p.min_height, "max_height", p.max_height);
  if (!(p.expected_up.norm() > 1e-3)) {
    errors.emplace_back("expected_up_x, _y, _z: expected a direction, got a vector of length 0");
  }
  return errors;
}

void setParameter(Parameters& parameters, const std::string& name, const std::string& value) {
  bool known = false;
  std::string names;
  visitParameters(parameters, [&](const ParameterInfo& info, auto& member) {
    names += (names.empty() ? "" : ", ") + std::string(info.name);
    if (name != info.name) return;
    known = true;
    parse(info, value, member);
  });
  if (!known) {
    throw std::invalid_argument("there is no parameter '" + name + "'; there are " + names);
  }
}

}  // namespace dominant_plane_detection
