// The command line of measure_noise, as users type it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "dominant_plane_detection/parameters.h"
#include "support/command.h"
#include "tools/yaml_files.h"

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;

class MeasureNoise : public testing::Test {
 protected:
  MeasureNoise()
      : folder_(fs::temp_directory_path() / ("measure_noise_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~MeasureNoise() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// A drive over an empty floor, as a RealSense sees it.
  std::string recordFloor() const {
    std::ofstream(path("floor.yaml"))
        << "camera: {width: 640, height: 480, fx: 575.8, fy: 575.8, cx: 319.5, cy: 239.5}\n"
           "noise: {sensor: realsense}\n"
           "path:\n  - {time: 0, position: [0, 0, 0.8], pitch: 0.45}\n"
           "  - {time: 1, position: [0.5, 0, 0.8], pitch: 0.45}\n"
           "objects:\n  - {shape: floor, size: [30, 30], ground: true}\n";
    const Outcome rendered = run(std::string(DPD_RENDER_SCENE) + " " + path("floor.yaml") +
                                 " --rate 8 --duration 1 --output " + path("floor.bag"));
    EXPECT_EQ(rendered.status, 0) << rendered.text;
    return path("floor.bag");
  }

  fs::path folder_;
};

/// The scene's octaves: bumps of 8 and 24 px are most of what 4 to 16 px err locally,
/// docs/scenes.md.
TEST_F(MeasureNoise, PrintsAProfileThatCanBeUsed) {
  const Outcome measured = run("(" + std::string(DPD_MEASURE_NOISE) + " " + recordFloor() + " > " +
                               path("mine.yaml") + ")");
  ASSERT_EQ(measured.status, 0) << measured.text;
  EXPECT_NE(measured.text.find("9 images"), std::string::npos) << measured.text;
  Parameters parameters;
  parameters.local_error = parameters.smooth_error = {0.1, 0.1};
  loadParameters(path("mine.yaml"), parameters);
  EXPECT_GT(parameters.local_error.sigma(1.25), 0.0012);
  EXPECT_LT(parameters.local_error.sigma(1.25), 0.0026);
  EXPECT_GT(parameters.local_error.sigma(2.25), 0.004);
  EXPECT_LT(parameters.local_error.sigma(2.25), 0.009);
  EXPECT_GT(parameters.smooth_error.sigma(1.25), 0.0005);
  EXPECT_LT(parameters.smooth_error.sigma(1.25), 0.002);
  EXPECT_LT(parameters.smooth_error.sigma(2.25), 0.008);
}

TEST_F(MeasureNoise, SaysWhyThereIsNoProfile) {
  const Outcome missing = run(std::string(DPD_MEASURE_NOISE) + " " + path("none.bag"));
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.text.find("none.bag"), std::string::npos) << missing.text;
  EXPECT_NE(missing.text.find("No image shows a ground plane."), std::string::npos) << missing.text;
  EXPECT_EQ(missing.text.find("smooth_error"), std::string::npos) << missing.text;
}

}  // namespace
}  // namespace dominant_plane_detection
