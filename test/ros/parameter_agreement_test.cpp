// The parameters stand in four places that users read; all have to say what the code does.

#include <dominant_plane_detection/PlaneDetectionConfig.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "core/parameter_table.h"
#include "ros/detection_parameters.h"
#include "ros/driver_parameters.h"

namespace dominant_plane_detection {
namespace {

std::string textOf(Algorithm value) { return configValue(value); }
std::string textOf(const VideoMode& value) { return configValue(value); }
std::string textOf(bool value) { return value ? "true" : "false"; }
template <typename T>
std::string textOf(T value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Every parameter with its default as text, in the table's order.
struct Row {
  std::string name, unit, text, value;
};
template <typename ParametersT>
std::vector<Row> tableRows() {
  std::vector<Row> rows;
  const ParametersT defaults;
  visitParameters(defaults, [&](const ParameterInfo& info, const auto& value) {
    rows.push_back({info.name, info.unit, info.text, textOf(value)});
  });
  return rows;
}

std::string sameNumber(const std::string& text) {
  std::istringstream stream(text);
  double number = 0.0;
  return stream >> number && stream.eof() ? textOf(number) : text;
}

std::vector<std::string> linesOf(const std::string& file) {
  std::ifstream stream(std::string(DPD_SOURCE) + "/" + file);
  EXPECT_TRUE(stream) << file;
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

template <typename ParametersT, typename Config>
void compareWithConfig() {
  Config config = Config::__getDefault__();
  const auto minimum = Config::__getMin__();
  const auto maximum = Config::__getMax__();
  const auto& descriptions = Config::__getParamDescriptions__();
  std::size_t i = 0;
  const ParametersT defaults;
  visitParameters(defaults, [&](const ParameterInfo& info, const auto& value) {
    ASSERT_LT(i, descriptions.size());
    const auto& description = *descriptions[i++];
    EXPECT_EQ(description.name, info.name);
    EXPECT_EQ(description.description, "[" + std::string(info.unit) + "] " + info.text);
    boost::any default_value, min, max;
    description.getValue(config, default_value);
    description.getValue(minimum, min);
    description.getValue(maximum, max);
    using T = std::decay_t<decltype(configValue(value))>;
    EXPECT_EQ(boost::any_cast<T>(default_value), configValue(value)) << info.name;
    if constexpr (std::is_arithmetic_v<T>) {
      EXPECT_EQ(boost::any_cast<T>(min), static_cast<T>(info.min)) << info.name;
      EXPECT_EQ(boost::any_cast<T>(max), static_cast<T>(info.max)) << info.name;
    }
  });
  EXPECT_EQ(i, descriptions.size());
}

TEST(ParameterAgreement, DynamicReconfigure) {
  compareWithConfig<Parameters, PlaneDetectionConfig>();
  compareWithConfig<DriverParameters, OpenNI2DriverConfig>();
}

TEST(ParameterAgreement, ConfigAndParametersConvertBothWays) {
  Parameters parameters;
  parameters.algorithm = Algorithm::kKdtree;
  parameters.range_max = 3.25;
  parameters.seeds = 5;
  parameters.expected_up = {0.1, -0.2, 0.3};
  const Parameters back = fromConfig<Parameters>(toConfig<PlaneDetectionConfig>(parameters));
  EXPECT_EQ(back.algorithm, Algorithm::kKdtree);
  EXPECT_EQ(back.range_max, 3.25);
  EXPECT_EQ(back.seeds, 5);
  EXPECT_EQ(back.expected_up, parameters.expected_up);
}

template <typename ParametersT>
void compareWithYaml(const std::string& file) {
  const std::vector<std::string> lines = linesOf(file);
  std::vector<std::string> expected, found;
  for (const Row& row : tableRows<ParametersT>()) {
    expected.push_back("# [" + row.unit + "] " + row.text);
    expected.push_back(row.name + ": " + row.value);
  }
  for (std::size_t i = 1; i < lines.size(); ++i) {  // the first line is the file's own comment
    const std::string& line = lines[i];
    const std::size_t colon = line.find(": ");
    if (line.empty()) continue;
    const bool comment = line[0] == '#';
    found.push_back(comment ? line
                            : line.substr(0, colon + 2) + sameNumber(line.substr(colon + 2)));
  }
  EXPECT_EQ(found, expected);
}

TEST(ParameterAgreement, Yaml) {
  compareWithYaml<Parameters>("config/default.yaml");
  compareWithYaml<DriverParameters>("config/driver.yaml");
}

TEST(ParameterAgreement, PaperYamlIsValid) {
  Parameters parameters;
  std::size_t values = 0;
  for (const std::string& line : linesOf("config/paper.yaml")) {
    const std::size_t colon = line.find(": ");
    if (line.empty() || line[0] == '#') continue;
    setParameter(parameters, line.substr(0, colon), line.substr(colon + 2));
    ++values;
  }
  EXPECT_GE(values, 8U);
  EXPECT_TRUE(findErrors(parameters).empty());
  EXPECT_EQ(parameters.algorithm, Algorithm::kKdtree);
  EXPECT_EQ(parameters.delta.sigmas, 0.0);
}

template <typename ParametersT>
void compareWithReadme() {
  std::map<std::string, std::string> table;
  std::vector<std::string> expected, found;
  for (const Row& row : tableRows<ParametersT>()) {
    expected.push_back("| `" + row.name + "` | " + row.value + " | " + row.unit + " | " + row.text +
                       " |");
  }
  for (const std::string& line : linesOf("README.md")) {
    for (const Row& row : tableRows<ParametersT>()) {
      const std::string begin = "| `" + row.name + "` | ";
      if (line.rfind(begin, 0) != 0) continue;
      const std::size_t end = line.find(" |", begin.size());
      found.push_back(begin + sameNumber(line.substr(begin.size(), end - begin.size())) +
                      line.substr(end));
    }
  }
  EXPECT_EQ(found, expected);
}

TEST(ParameterAgreement, Readme) {
  compareWithReadme<Parameters>();
  compareWithReadme<DriverParameters>();
}

}  // namespace
}  // namespace dominant_plane_detection
