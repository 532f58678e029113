#include "calibration/depth_calibration_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/disparity_table.h"

namespace dominant_plane_detection {
namespace {

const std::string kShipped = DPD_SOURCE "/config/depth_calibration/";

class CalibrationFile : public testing::Test {
 protected:
  CalibrationFile()
      : file_(std::filesystem::temp_directory_path() /
              ("calibration_" + std::to_string(getpid()) + ".yaml")) {}
  ~CalibrationFile() override { std::filesystem::remove(file_); }

  std::string problemOf(const std::string& text) {
    std::ofstream(file_) << text;
    try {
      loadDepthCalibration(file_);
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file_), std::string::npos) << error.what();
      return error.what();
    }
    return "none";
  }

  std::string file_;
};

TEST_F(CalibrationFile, ComesBackAsItWasWritten) {
  for (const DepthCalibration& written : {DepthCalibration::kinect(), DepthCalibration::paper()}) {
    saveDepthCalibration(file_, {written, {written.form, 0.1, 0.2, 0.3, 0.4}, "a test: with #"});
    const DepthCalibration read = loadDepthCalibration(file_);
    EXPECT_EQ(read.form, written.form);
    EXPECT_DOUBLE_EQ(read.a, written.a);
    EXPECT_DOUBLE_EQ(read.b, written.b);
    EXPECT_DOUBLE_EQ(read.c, written.c);
    EXPECT_DOUBLE_EQ(read.d, written.d);
  }
  EXPECT_THROW(saveDepthCalibration("/no/such/folder/x.yaml", {}), std::runtime_error);
}

TEST_F(CalibrationFile, ShippedOnesAreWhatTheyAreSaidToBe) {
  const DepthCalibration reciprocal = loadDepthCalibration(kShipped + "kinect_reciprocal.yaml");
  EXPECT_EQ(reciprocal.form, DepthCalibration::Form::kReciprocal);
  EXPECT_DOUBLE_EQ(reciprocal.a, DepthCalibration::kinect().a);
  EXPECT_DOUBLE_EQ(reciprocal.b, DepthCalibration::kinect().b);
  // Eq. 1 with the printed constants [mm], as the paper's own scaling of D gives it.
  const DepthCalibration paper = loadDepthCalibration(kShipped + "paper.yaml");
  EXPECT_NEAR(1000.0 * paper.evaluate(25), 3.4, 0.05);
  EXPECT_NEAR(1000.0 * paper.evaluate(50), 407, 0.5);
  EXPECT_NEAR(1000.0 * paper.evaluate(100), 753, 0.5);
  EXPECT_NEAR(1000.0 * paper.evaluate(500), 1060, 0.5);
  EXPECT_NEAR(1000.0 * paper.evaluate(1000), 1323, 0.5);
  EXPECT_NEAR(1000.0 * paper.evaluate(2047), 2106, 0.5);
  EXPECT_EQ(paper.distance(24), 0.0) << "negative";
  const DepthCalibration exponential = loadDepthCalibration(kShipped + "kinect_exponential.yaml");
  for (int raw = 0; raw < 2047; ++raw) {
    const double z = reciprocal.distance(raw);
    if (z < 0.5 || z > 4.0) continue;
    EXPECT_NEAR(exponential.evaluate(raw), z, std::min(0.02 * z, 0.06)) << raw;
  }
}

TEST_F(CalibrationFile, ExplainsWhatIsWrong) {
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(problemOf(""), "NAME: VALUE"));
  EXPECT_TRUE(has(problemOf("a: 1\nb: 2\n"), "form"));
  EXPECT_TRUE(has(problemOf("form: linear\na: 1\nb: 2\n"), "got linear"));
  EXPECT_TRUE(has(problemOf("form: reciprocal\na: 3.33\n"), "b: expected a number"));
  EXPECT_TRUE(has(problemOf("form: reciprocal\na: 3.33\nb: x\n"), "got 'x'"));
  EXPECT_TRUE(has(problemOf("form: reciprocal\na: 3.33\nb: -0.003\nc: 1\n"), "no c"));
  EXPECT_TRUE(
      has(problemOf("form: exponential\na: 848.7\nb: 0.000444\nc: 10\nd: -0.0247\n"), "metres"));
  EXPECT_TRUE(has(problemOf("form: reciprocal\na: -3.33\nb: -0.003\n"), "metres"));
  EXPECT_TRUE(has(problemOf("form: [\n"), "line"));
  std::filesystem::remove(file_);
  EXPECT_THROW(loadDepthCalibration(file_), std::runtime_error);
}

TEST(DisparityTableTest, HasTheCalibrationInMillimetres) {
  const DepthCalibration kinect = DepthCalibration::kinect();
  const DisparityTable table(kinect);
  for (std::uint16_t raw = 0; raw < 1079; ++raw) {  // beyond, 65 m
    ASSERT_NEAR(table[raw], 1000.0 * kinect.evaluate(raw), 0.5001) << raw;
  }
  for (int raw = 1080; raw < 65536; ++raw) {
    ASSERT_EQ(table[static_cast<std::uint16_t>(raw)], 0) << raw;
  }
}

TEST(DisparityTableTest, OffsetAndScaleComeBeforeTheRounding) {
  const DisparityTable table(DepthCalibration::kinect(), -0.6, 1.1);
  EXPECT_EQ(table[300], 0) << "not before the camera any more";
  EXPECT_EQ(table[2047], 0);
  const double z = DepthCalibration::kinect().evaluate(900);
  EXPECT_NEAR(table[900], 1000.0 * (1.1 * z - 0.6), 0.5001);
  std::uint16_t readings[] = {900, 2047, 300, 900};
  table.apply(readings, 3, readings);
  EXPECT_EQ(readings[0], table[900]);
  EXPECT_EQ(readings[1], 0);
  EXPECT_EQ(readings[2], 0);
  EXPECT_EQ(readings[3], 900) << "beyond the end";
}

}  // namespace
}  // namespace dominant_plane_detection
