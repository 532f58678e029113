#include "dominant_plane_detection/parameters.h"

#include "core/parameter_text.h"

namespace dominant_plane_detection {

std::vector<std::string> findErrors(const Parameters& p) {
  std::vector<std::string> errors = findRangeErrors(p);
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
  setByName(parameters, name, value);
}

}  // namespace dominant_plane_detection
