// What scripts/update_parameters writes is what the code does, and reads back as what it was.

#include <dominant_plane_detection/OpenNI2DriverConfig.h>
#include <dominant_plane_detection/PlaneDetectionConfig.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/parameter_table.h"
#include "ros/detection_parameters.h"
#include "ros/driver_parameters.h"

namespace dominant_plane_detection {
namespace {

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
    if constexpr (kHasLimits<T>) {
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

/// Sets the parameters that a YAML file names.
/// @return [#] how many.
template <typename ParametersT>
std::size_t readYaml(const std::string& file, ParametersT& parameters) {
  std::ifstream stream(std::string(DPD_SOURCE) + "/" + file);
  EXPECT_TRUE(stream) << file;
  std::size_t values = 0;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (line.empty() || line[0] == '#') continue;
    setParameter(parameters, line.substr(0, colon), line.substr(colon + 2));
    ++values;
  }
  EXPECT_TRUE(findErrors(parameters).empty());
  return values;
}

TEST(ParameterAgreement, YamlOfDefaults) {
  Parameters detection;  // other than the defaults, in one value of each type
  detection.algorithm = Algorithm::kKdtree;
  detection.seeds = 5;
  detection.noise.quadratic = 0.05;
  EXPECT_EQ(readYaml("config/default.yaml", detection), parameterNames<Parameters>().size());
  EXPECT_EQ(detection.algorithm, Parameters().algorithm);
  EXPECT_EQ(detection.seeds, Parameters().seeds);
  EXPECT_EQ(detection.noise.quadratic, Parameters().noise.quadratic);

  DriverParameters driver;
  driver.camera.depth_mode = {320, 240, 60};
  driver.camera.repeat = false;
  EXPECT_EQ(readYaml("config/driver.yaml", driver), parameterNames<DriverParameters>().size());
  EXPECT_EQ(driver.camera, CameraSettings());
}

TEST(ParameterAgreement, PaperYamlIsValid) {
  Parameters parameters;
  EXPECT_GE(readYaml("config/paper.yaml", parameters), 8U);
  EXPECT_EQ(parameters.algorithm, Algorithm::kKdtree);
  EXPECT_EQ(parameters.delta.sigmas, 0.0);
}

}  // namespace
}  // namespace dominant_plane_detection
