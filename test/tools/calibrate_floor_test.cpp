// The command line of calibrate_floor, as users type it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "calibration/depth_correction_file.h"
#include "support/command.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCamera = " --camera 525,525,319.5,239.5";

/// Twelve floors by a camera with a fixed error, and by one without any.
class CalibrateFloor : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("calibrate_floor_test_" + std::to_string(getpid()));
    for (const char* name : {"/fixed", "/exact"}) fs::create_directories(folder_.string() + name);
    for (int i = 0; i < 12; ++i) {
      const OwnedDepth<float> floor =
          planeDepth(testCamera(), upOf(0.5 + 0.03 * i, 0.02 * i - 0.1), 0.7 + 0.05 * i);
      write(floor, 0.0, path("exact/" + std::to_string(100 + i) + ".png"));
      write(floor, 0.004, path("fixed/" + std::to_string(100 + i) + ".png"));
    }
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  /// @param size [1/m] of the error.
  static void write(OwnedDepth<float> floor, double size, const std::string& file) {
    shiftInverseDepth(floor, [&](int u, int v) { return size * fixedError(u, v); });
    cv::Mat depth(480, 640, CV_16UC1);
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) {
        depth.at<std::uint16_t>(v, u) =
            static_cast<std::uint16_t>(std::lround(5000.0F * floor.at(u, v)));
      }
    }
    cv::imwrite(file, depth);
  }
  static std::string path(const std::string& name) { return (folder_ / name).string(); }
  static Outcome calibrate(const std::string& arguments) {
    return run(std::string(DPD_CALIBRATE_FLOOR) + " " + arguments + " --depth-scale 5000" +
               kCamera);
  }
  /// @return [m^2] of the first image by detect_planes.
  static double meanSquareError(const std::string& arguments) {
    const Outcome outcome =
        run(std::string(DPD_DETECT_PLANES) + " " + path("fixed/105.png") + " --depth-scale 5000" +
            kCamera + " --output " + path("out") + " " + arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    std::ifstream table(path("out/planes.csv"));
    std::string line, field;
    std::getline(table, line);
    std::getline(table, line);
    std::istringstream fields(line);
    for (int i = 0; i < 7; ++i) std::getline(fields, field, ',');
    return std::stod(field);
  }

  static fs::path folder_;
};
fs::path CalibrateFloor::folder_;

TEST_F(CalibrateFloor, WritesWhatTheOtherToolsApply) {
  const Outcome learned = calibrate(path("fixed") + " --output " + path("mine.yaml"));
  ASSERT_EQ(learned.status, 0) << learned.text;
  EXPECT_NE(learned.text.find("12 images"), std::string::npos) << learned.text;
  EXPECT_EQ(loadDepthCorrection(path("mine.yaml")).grid().columns, 20);
  const double before = meanSquareError(""),
               after = meanSquareError("--correction " + path("mine.yaml"));
  EXPECT_LT(after, 0.2 * before);
}

TEST_F(CalibrateFloor, WritesNothingWhereItWouldNotHelp) {
  const Outcome refused = calibrate(path("exact") + " --output " + path("none.yaml"));
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.text.find("not fixed"), std::string::npos) << refused.text;
  EXPECT_FALSE(fs::exists(path("none.yaml")));
}

TEST_F(CalibrateFloor, SaysWhatIsWrong) {
  const Outcome few = calibrate(path("fixed/100.png") + " --output " + path("none.yaml"));
  EXPECT_EQ(few.status, 1);
  EXPECT_NE(few.text.find("at least 10"), std::string::npos) << few.text;
  std::ofstream(path("twice.yaml")) << "columns: 1\nrows: 1\ninverse_depth: [0.01]\n";
  const Outcome twice = calibrate(path("fixed") + " --correction " + path("twice.yaml") +
                                  " --output " + path("none.yaml"));
  EXPECT_EQ(twice.status, 1);
  EXPECT_NE(twice.text.find("--correction"), std::string::npos) << twice.text;
  const Outcome missing = calibrate(path("fixed") + " --output /nowhere/c.yaml");
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.text.find("/nowhere/c.yaml"), std::string::npos) << missing.text;
  const Outcome broken = run(std::string(DPD_DETECT_PLANES) + " " + path("fixed") + kCamera +
                             " --correction " + path("fixed/100.png") + " --output " + path("out"));
  EXPECT_EQ(broken.status, 1);
  EXPECT_NE(broken.text.find("100.png"), std::string::npos) << broken.text;
}

}  // namespace
}  // namespace dominant_plane_detection
