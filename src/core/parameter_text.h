#pragma once

#include <charconv>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "core/parameter_table.h"

namespace dominant_plane_detection {

// Reading and checking of any set of parameters that has a `visitParameters`.

/// @throw std::invalid_argument with the parameter's name and unit, what was expected and what
/// came.
template <typename T>
std::enable_if_t<std::is_arithmetic_v<T>> parseValue(const ParameterInfo& info,
                                                     const std::string& text, T& value) {
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

inline void parseValue(const ParameterInfo& info, const std::string& text, bool& value) {
  const bool yes = text == "true" || text == "1";
  if (!yes && text != "false" && text != "0") {
    throw std::invalid_argument(std::string(info.name) + ": expected true or false, got '" + text +
                                "'");
  }
  value = yes;
}

inline void parseValue(const ParameterInfo&, const std::string& text, std::string& value) {
  value = text;
}

template <typename Choice>
std::enable_if_t<std::is_enum_v<Choice>> parseValue(const ParameterInfo& info,
                                                    const std::string& text, Choice& value) {
  constexpr auto& kNames = kChoiceNames<Choice>;
  std::string names;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (text == kNames[i]) {
      value = static_cast<Choice>(i);
      return;
    }
    names += (i == 0 ? "" : i + 1 == kNames.size() ? " or " : ", ") + std::string(kNames[i]);
  }
  throw std::invalid_argument(std::string(info.name) + ": expected " + names + ", got '" + text +
                              "'");
}

/// @return one sentence for each number outside its limits.
template <typename ParametersT>
std::vector<std::string> findRangeErrors(const ParametersT& parameters) {
  std::vector<std::string> errors;
  visitParameters(parameters, [&](const ParameterInfo& info, const auto& value) {
    if constexpr (kHasLimits<std::decay_t<decltype(value)>>) {
      const double number = value;
      if (info.min <= number && number <= info.max) return;  // not so for NaN
      std::ostringstream text;
      text << info.name << ": expected " << info.min << " to " << info.max << " " << info.unit
           << ", got " << number;
      errors.push_back(text.str());
    }
  });
  return errors;
}

/// @throw std::invalid_argument for a name that does not exist (lists those that do) and for a text
/// that is not a value of the parameter's type.
template <typename ParametersT>
void setByName(ParametersT& parameters, const std::string& name, const std::string& value) {
  bool known = false;
  std::string names;
  visitParameters(parameters, [&](const ParameterInfo& info, auto& member) {
    names += (names.empty() ? "" : ", ") + std::string(info.name);
    if (name != info.name) return;
    known = true;
    parseValue(info, value, member);
  });
  if (!known) {
    throw std::invalid_argument("there is no parameter '" + name + "'; there are " + names);
  }
}

}  // namespace dominant_plane_detection
