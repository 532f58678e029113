#include "calibration/depth_calibration_file.h"

#include <limits>
#include <set>
#include <stdexcept>

#include "calibration/yaml_text.h"
#include "core/disparity_table.h"

namespace dominant_plane_detection {
namespace {

using Form = DepthCalibration::Form;

Form parseForm(const YAML::Node& root) {
  const auto name = root["form"] ? root["form"].as<std::string>() : "nothing";
  if (name == "reciprocal") return Form::kReciprocal;
  if (name == "exponential") return Form::kExponential;
  throw std::runtime_error("form: expected reciprocal or exponential, got " + name);
}

double parseConstant(const YAML::Node& root, const char* name) {
  const YAML::Node node = root[name];
  if (!node) throw std::runtime_error(std::string(name) + ": expected a number, got nothing");
  try {
    return node.as<double>();
  } catch (const YAML::Exception&) {
    throw std::runtime_error(std::string(name) + ": expected a number, got '" +
                             (node.IsScalar() ? node.Scalar() : "a list or a structure") + "'");
  }
}

/// @return the names of a form's constants.
std::set<std::string> constants(Form form) {
  return form == Form::kExponential ? std::set<std::string>{"a", "b", "c", "d"}
                                    : std::set<std::string>{"a", "b"};
}

DepthCalibration parse(const YAML::Node& root) {
  if (!root.IsMap()) throw std::runtime_error("expected lines of the form NAME: VALUE");
  DepthCalibration calibration;
  calibration.form = parseForm(root);
  std::set<std::string> known = constants(calibration.form);
  known.insert({"form", "standard_errors", "description"});
  for (const auto& entry : root) {
    const auto name = entry.first.as<std::string>();
    if (known.count(name) == 0) {
      throw std::runtime_error("there is no " + name + " in the form " +
                               root["form"].as<std::string>());
    }
  }
  calibration.a = parseConstant(root, "a");
  calibration.b = parseConstant(root, "b");
  if (calibration.form == Form::kExponential) {
    calibration.c = parseConstant(root, "c");
    calibration.d = parseConstant(root, "d");
  }
  return calibration;
}

/// Constants in other units, say, make a table of nothing.
void requireReadings(const DepthCalibration& calibration) {
  const DisparityTable table(calibration);
  for (std::uint16_t raw = 0; raw < DisparityTable::kSize; ++raw) {
    if (table[raw] != 0) return;
  }
  throw std::runtime_error(
      "expected constants in metres, got some that give no raw value a distance below 65 m");
}

}  // namespace

DepthCalibration loadDepthCalibration(const std::string& file) {
  return readYaml(file, "a depth calibration", [](const YAML::Node& root) {
    const DepthCalibration calibration = parse(root);
    requireReadings(calibration);
    return calibration;
  });
}

void saveDepthCalibration(const std::string& file, const DepthCalibrationFile& content) {
  const DepthCalibration& c = content.calibration;
  const DepthCalibration& e = content.standard_errors;
  const bool exponential = c.form == Form::kExponential;
  YAML::Emitter out;
  out.SetDoublePrecision(std::numeric_limits<double>::max_digits10 - 1);
  out << YAML::Comment(exponential ? "Z = a exp(b D) + c exp(d D), [a, c] = m, [b, d] = 1"
                                   : "Z = 1 / (a + b D), [a, b] = 1/m")
      << YAML::Newline << YAML::BeginMap;
  out << YAML::Key << "form" << YAML::Value << (exponential ? "exponential" : "reciprocal");
  out << YAML::Key << "a" << YAML::Value << c.a << YAML::Key << "b" << YAML::Value << c.b;
  if (exponential) {
    out << YAML::Key << "c" << YAML::Value << c.c << YAML::Key << "d" << YAML::Value << c.d;
  }
  if (e.a > 0.0) {
    out << YAML::Key << "standard_errors" << YAML::Value << YAML::Flow << YAML::BeginMap;
    out << YAML::Key << "a" << YAML::Value << e.a << YAML::Key << "b" << YAML::Value << e.b;
    if (exponential) {
      out << YAML::Key << "c" << YAML::Value << e.c << YAML::Key << "d" << YAML::Value << e.d;
    }
    out << YAML::EndMap;
  }
  if (!content.description.empty()) {
    out << YAML::Key << "description" << YAML::Value << content.description;
  }
  out << YAML::EndMap;
  writeYaml(file, out);
}

}  // namespace dominant_plane_detection
