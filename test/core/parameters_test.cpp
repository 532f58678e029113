#include "dominant_plane_detection/parameters.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <set>
#include <stdexcept>

#include "core/parameter_text.h"
#include "dominant_plane_detection/dominant_plane_detector.h"

namespace dominant_plane_detection {
namespace {

TEST(Parameters, DefaultsAreValid) { EXPECT_TRUE(findErrors(Parameters()).empty()); }

TEST(Parameters, LimitsHoldTheDefaultsAndEveryAlgorithm) {
  const Parameters parameters;
  visitParameters(parameters, [&](const ParameterInfo& info, const auto& value) {
    EXPECT_LE(info.min, static_cast<double>(value)) << info.name;
    EXPECT_GE(info.max, static_cast<double>(value)) << info.name;
    if (std::string(info.name) != "algorithm") return;
    EXPECT_EQ(info.min, 0.0);
    EXPECT_EQ(info.max, static_cast<double>(Algorithm::kKdtree));
  });
}

TEST(Parameters, TableNamesAreUnique) {
  const Parameters parameters;
  std::set<std::string> names;
  visitParameters(parameters, [&](const ParameterInfo& info, const auto&) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
  });
  EXPECT_GT(names.size(), 20U);
}

/// What dynamic_reconfigure was given stands in a file that is written from the table and kept.
TEST(Parameters, TheTableIsWhatItWasWhenTheConfigWasWritten) {
  std::ifstream file(std::string(DPD_SOURCE) + "/cfg/PlaneDetection.cfg");
  ASSERT_TRUE(file);
  const std::string config((std::istreambuf_iterator<char>(file)), {});
  const std::regex entry(
      "gen\\.add\\(\"(\\w+)\", (\\w+), 0,\\s+\"\\[(.+)\\] (.+)\",\\s+([^,)]+)"
      "(?:, ([^,)=]+), ([^,)]+))?");
  std::sregex_iterator next(config.begin(), config.end(), entry);
  const Parameters parameters;
  visitParameters(parameters, [&](const ParameterInfo& info, const auto& value) {
    ASSERT_NE(next, std::sregex_iterator()) << info.name;
    const std::smatch found = *next;
    ++next;
    EXPECT_EQ(found[1], info.name);
    EXPECT_EQ(found[3], info.unit) << info.name;
    EXPECT_EQ(found[4], info.text) << info.name;
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, int> || std::is_same_v<T, double>) {
      EXPECT_EQ(std::stod(found[5]), static_cast<double>(value)) << info.name;
      EXPECT_EQ(std::stod(found[6]), info.min) << info.name;
      EXPECT_EQ(std::stod(found[7]), info.max) << info.name;
    } else if constexpr (std::is_same_v<T, bool>) {
      EXPECT_EQ(found[5], value ? "True" : "False") << info.name;
    } else {
      const auto name = std::string(kChoiceNames<T>[static_cast<std::size_t>(value)]);
      EXPECT_EQ(found[5], '"' + name + '"') << info.name;
    }
  });
  EXPECT_EQ(next, std::sregex_iterator());
}

TEST(Parameters, AllErrorsAtOnceWithNameRangeAndUnit) {
  Parameters parameters;
  parameters.range_min = std::numeric_limits<double>::quiet_NaN();
  parameters.seeds = 0;
  parameters.min_height = 5.0;
  parameters.max_height = 4.0;
  parameters.expected_up.setZero();
  const std::vector<std::string> errors = findErrors(parameters);
  ASSERT_EQ(errors.size(), 5U);  // range_min twice: out of range, and not below range_max
  EXPECT_EQ(errors[0], "range_min: expected 0.05 to 20 m, got nan");
  EXPECT_EQ(errors[1], "seeds: expected 1 to 10000 #, got 0");
  EXPECT_NE(errors[3].find("min_height has to be smaller than max_height"), std::string::npos);
  EXPECT_NE(errors[4].find("expected_up"), std::string::npos);
  EXPECT_THROW(DominantPlaneDetector{parameters}, std::invalid_argument);
}

TEST(Parameters, SetFromText) {
  Parameters parameters;
  setParameter(parameters, "range_max", "3.5");
  setParameter(parameters, "seeds", "7");
  setParameter(parameters, "algorithm", "kdtree");
  setParameter(parameters, "expected_up_z", "-1e-1");
  EXPECT_EQ(parameters.range_max, 3.5);
  EXPECT_EQ(parameters.seeds, 7);
  EXPECT_EQ(parameters.algorithm, Algorithm::kKdtree);
  EXPECT_EQ(parameters.expected_up.z(), -0.1);
}

struct Switches {
  bool on = false;
};
template <typename SwitchesT, typename Visitor, IfParameters<SwitchesT, Switches> = 0>
void visitParameters(SwitchesT& switches, Visitor&& visit) {
  visit(ParameterInfo{"on", "-", 0, 0, "a switch has no limits"}, switches.on);
}

TEST(Parameters, SwitchesAreTrueOrFalse) {
  Switches switches;
  setByName(switches, "on", "true");
  EXPECT_TRUE(switches.on);
  EXPECT_TRUE(findRangeErrors(switches).empty());
  setByName(switches, "on", "0");
  EXPECT_FALSE(switches.on);
  for (const char* text : {"", "2", "yes", "True"}) {
    EXPECT_THROW(setByName(switches, "on", text), std::invalid_argument) << text;
  }
}

TEST(Parameters, RefuseWhatIsNoValueOrNoName) {
  Parameters parameters;
  for (const char* text : {"", "3.5m", "x", "3,5", " 3"}) {
    EXPECT_THROW(setParameter(parameters, "range_max", text), std::invalid_argument) << text;
  }
  EXPECT_THROW(setParameter(parameters, "seeds", "1.5"), std::invalid_argument);
  EXPECT_THROW(setParameter(parameters, "algorithm", "ransac"), std::invalid_argument);
  EXPECT_EQ(parameters.range_max, Parameters().range_max);
  try {
    setParameter(parameters, "range_maximum", "3");
    FAIL() << "an unknown name was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("range_max,"), std::string::npos);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
