// What scripts/update_parameters writes is what the code does, and reads back as what it was.

#include <dominant_plane_detection/OpenNI2DriverConfig.h>
#include <dominant_plane_detection/PlaneDetectionConfig.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/parameter_table.h"
#include "ros/driver_parameters.h"
#include "ros/node_parameters.h"
#include "ros/parameter_file.h"
#include "ros/robot_body.h"

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

TEST(NodeParameters, AreReadByTheirNames) {
  NodeParameters parameters;
  setParameter(parameters, "base_frame", "base_link");
  setParameter(parameters, "publish_tf", "base");
  setParameter(parameters, "smoothing_time", "0.5");
  setParameter(parameters, "stride", "4");
  EXPECT_EQ(parameters.base_frame, "base_link");
  EXPECT_EQ(parameters.publish_tf, TfOutput::kBase);
  EXPECT_EQ(parameters.smoothing_time, 0.5);
  EXPECT_EQ(parameters.stride, 4);
  // As a switch, which it is in other packages.
  setParameter(parameters, "publish_tf", "true");
  EXPECT_EQ(parameters.publish_tf, TfOutput::kGround);
  setParameter(parameters, "publish_tf", "false");
  EXPECT_EQ(parameters.publish_tf, TfOutput::kNone);
  EXPECT_THROW(setParameter(parameters, "publish_tf", "maybe"), std::invalid_argument);
  EXPECT_THROW(setParameter(parameters, "use_imu", "maybe"), std::invalid_argument);
  parameters.stride = 0;
  parameters.ground_frame.clear();
  EXPECT_EQ(findErrors(parameters).size(), 2U);
  for (const std::string& name : parameterNames<NodeParameters>()) {
    EXPECT_EQ(nodeletParameters().count(name), 1U) << name;  // not the detection's in a file
  }
}

TEST(NodeParameters, ContradictionsGoBackToTheDefaults) {
  NodeParameters parameters;
  EXPECT_TRUE(refuseContradictions(parameters).empty());
  parameters.clearance_height = 3.0;
  parameters.publish_tf = TfOutput::kBase;
  parameters.clouds_in_base_frame = true;
  parameters.stride = 7;
  EXPECT_EQ(refuseContradictions(parameters).size(), 3U);
  EXPECT_EQ(parameters.clearance_height, 0.0);
  EXPECT_EQ(parameters.publish_tf, TfOutput::kNone);
  EXPECT_FALSE(parameters.clouds_in_base_frame);
  EXPECT_EQ(parameters.stride, 7);
  parameters.base_frame = "base_link";
  parameters.publish_tf = TfOutput::kBase;
  parameters.clouds_in_base_frame = true;
  parameters.smoothing_time = 0.5;
  EXPECT_TRUE(refuseContradictions(parameters).empty());
  parameters.tracking = false;
  parameters.ground_frame = "base_link";
  EXPECT_EQ(refuseContradictions(parameters).size(), 4U);  // and what then needs a base_frame
  EXPECT_EQ(parameters.smoothing_time, 0.0);
  EXPECT_EQ(parameters.base_frame, "");
}

TEST(NodeParameters, TheRobotsBodyIsAListOfBoxes) {
  const auto boxes = [](const std::string& text) {
    XmlRpc::XmlRpcValue value;
    int offset = 0;
    value.fromXml(text, &offset);
    return asBoxes(value);
  };
  const std::string number = "<value><double>0.5</double></value>",
                    zero = "<value><int>0</int></value>";
  const auto corner = [&](const char* name, const std::string& a) {
    return "<member><name>" + std::string(name) + "</name><value><array><data>" + a + a + a +
           "</data></array></value></member>";
  };
  const auto list = [](const std::string& members) {
    return "<value><array><data><value><struct>" + members +
           "</struct></value></data></array></value>";
  };
  const auto body = boxes(list(corner("min", zero) + corner("max", number)));
  ASSERT_EQ(body.size(), 1U);
  EXPECT_EQ(body[0].min(), Eigen::Vector3d::Zero());
  EXPECT_EQ(body[0].max(), Eigen::Vector3d::Constant(0.5));
  EXPECT_TRUE(boxes("<value><array><data></data></array></value>").empty());
  EXPECT_THROW(boxes(zero), std::invalid_argument);
  EXPECT_THROW(boxes(list(corner("min", zero))), std::invalid_argument);
  EXPECT_THROW(boxes(list(corner("min", number) + corner("max", zero))), std::invalid_argument);
}

}  // namespace
}  // namespace dominant_plane_detection
