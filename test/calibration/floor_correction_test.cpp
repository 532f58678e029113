#include "calibration/floor_correction.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "calibration/depth_correction_file.h"
#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/corrected_set.h"
#include "support/halves.h"
#include "support/recordings.h"
#include "support/scoring.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;

TEST(DepthCorrection, ShiftsInverseDepthBilinearlyBetweenCells) {
  DepthCorrection correction({2, 1, {0.01, 0.03}});
  OwnedDepth<float> depth(400, 100);
  std::fill(depth.pixels.begin(), depth.pixels.end(), 2.0F);
  depth.at(10, 5) = 0.0F;
  depth.at(11, 5) = std::numeric_limits<float>::quiet_NaN();
  depth.at(12, 5) = std::numeric_limits<float>::infinity();
  const DepthView corrected = correction.correct(depth.view());
  ASSERT_EQ(corrected.width, 400);
  ASSERT_EQ(corrected.height, 100);
  const auto c = [&](int u, int v) {
    return 1.0 / 2.0 - 1.0 / static_cast<double>(metresAt(corrected, u, v));
  };
  EXPECT_NEAR(c(3, 50), 0.01, 1e-6) << "beyond the first cell's middle";
  EXPECT_NEAR(c(396, 50), 0.03, 1e-6);
  EXPECT_NEAR(c(200, 0), 0.02 + 0.02 * 0.5 / 200.0, 1e-6);
  EXPECT_NEAR(c(150, 99), 0.015 + 0.02 * 0.5 / 200.0, 1e-6);
  EXPECT_EQ(metresAt(corrected, 10, 5), 0.0F);
  EXPECT_TRUE(std::isnan(metresAt(corrected, 11, 5)));
  EXPECT_TRUE(std::isinf(metresAt(corrected, 12, 5)));
}

/// What is farther than 1 / c is infinitely far; rows may be padded; and nothing stays nothing.
TEST(DepthCorrection, KeepsWhatIsFarAndEmpty) {
  DepthCorrection correction({1, 1, {0.1}});
  std::vector<float> padded(2 * 8, 3.0F);
  padded[1] = 9.9F;
  padded[8] = 11.0F;
  const DepthView corrected = correction.correct(DepthView(padded.data(), 3, 2, 8 * sizeof(float)));
  EXPECT_NEAR(static_cast<double>(metresAt(corrected, 0, 0)), 1.0 / (1.0 / 3.0 - 0.1), 1e-5);
  EXPECT_NEAR(static_cast<double>(metresAt(corrected, 1, 0)), 9.9 / 0.01, 1.0);
  EXPECT_TRUE(std::isinf(metresAt(corrected, 0, 1)));
  EXPECT_EQ(correction.correct(DepthView()).data, nullptr);
}

TEST(DepthCorrection, TakesAnySizeAndUnit) {
  DepthCorrection correction({1, 2, {0.0, 0.02}});
  const std::vector<std::uint16_t> pixels(40, 10000);
  const DepthView fifths(pixels.data(), 4, 10, 0.0002F);
  const DepthView corrected = correction.correct(fifths);
  EXPECT_FLOAT_EQ(metresAt(corrected, 0, 0), 2.0F);
  EXPECT_NEAR(static_cast<double>(metresAt(corrected, 3, 9)), 1.0 / (0.5 - 0.02), 1e-5);
  const DepthView wide(pixels.data(), 20, 2, 0.0002F);
  EXPECT_EQ(correction.correct(wide).width, 20);
}

TEST(DepthCorrection, RefusesWhatIsNone) {
  EXPECT_THROW(DepthCorrection({0, 0, {}}), std::invalid_argument);
  EXPECT_THROW(DepthCorrection({2, 2, {0.0, 0.0, 0.0}}), std::invalid_argument);
  EXPECT_THROW(DepthCorrection({1, 1, {std::nan("")}}), std::invalid_argument);
  EXPECT_THROW(DepthCorrection({1, 1, {0.2}}), std::invalid_argument);
  EXPECT_THROW(DepthCorrection({-1, -1, {0.0}}), std::invalid_argument);
}

/// Floors from many poses by a camera whose inverse depth is off by what is fixed to its pixels.
class FixedError : public testing::Test {
 protected:
  /// @return [1/m]
  static double pattern(double u, double v) {
    return 0.004 * fixedError(u, v) + 0.003 * std::cos(u / 200.0 + v / 90.0);
  }
  /// @return a floor as the camera reads it.
  OwnedDepth<float> sense(const Eigen::Vector3d& up, double height, double strength, double white,
                          unsigned seed) const {
    std::mt19937 generator(seed);
    std::normal_distribution<double> gauss(0.0, white);
    OwnedDepth<float> depth = planeDepth(camera_, up, height);
    shiftInverseDepth(depth,
                      [&](int u, int v) { return strength * pattern(u, v) + gauss(generator); });
    return depth;
  }
  void add(FloorCorrection& correction, int images, double strength, double white) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> height(0.6, 1.4), pitch(0.5, 0.9), roll(-0.2, 0.2);
    for (int i = 0; i < images; ++i) {
      const Eigen::Vector3d up = upOf(pitch(generator), roll(generator));
      const OwnedDepth<float> depth =
          sense(up, height(generator), strength, white, static_cast<unsigned>(i));
      correction.add(depth.view(), camera_, detector_.detect(depth.view(), camera_));
    }
  }

  const CameraModel camera_ = testCamera();
  DominantPlaneDetector detector_;
};

/// @return [1/m] rms of what of a grid's cells is not affine in the image.
double notAffine(const DepthCorrection::Grid& grid) {
  const auto cells = static_cast<Eigen::Index>(grid.inverse_depth.size());
  Eigen::MatrixX3d place(cells, 3);
  for (Eigen::Index i = 0; i < cells; ++i) {
    place.row(i) << static_cast<double>(i % grid.columns), static_cast<double>(i / grid.columns),
        1.0;
  }
  const Eigen::VectorXd values =
      Eigen::Map<const Eigen::VectorXd>(grid.inverse_depth.data(), cells);
  const Eigen::Vector3d affine =
      (place.transpose() * place).ldlt().solve(place.transpose() * values);
  return std::sqrt((values - place * affine).squaredNorm() / static_cast<double>(cells));
}

TEST_F(FixedError, IsLearned) {
  FloorCorrection correction{NoiseModel()};
  add(correction, 30, 1.0, 0.002);
  ASSERT_EQ(correction.images(), 30U);
  const FloorCorrection::Result learned = correction.learn();
  EXPECT_LT(learned.after, 0.3 * learned.before);
  ASSERT_EQ(learned.grid.columns, 20);
  ASSERT_EQ(learned.grid.rows, 15);
  DepthCorrection::Grid truth = learned.grid, left = learned.grid;
  for (int row = 0; row < 15; ++row) {
    for (int column = 0; column < 20; ++column) {
      const auto cell = static_cast<std::size_t>(row * 20 + column);
      double sum = 0.0;
      for (int v = 0; v < 32; ++v) {
        for (int u = 0; u < 32; ++u) sum += pattern(32.0 * column + u, 32.0 * row + v);
      }
      truth.inverse_depth[cell] = sum / 1024.0;
      left.inverse_depth[cell] -= sum / 1024.0;
    }
  }
  RecordProperty("left", std::to_string(notAffine(left) / notAffine(truth)));
  EXPECT_LT(notAffine(left), 0.3 * notAffine(truth));
}

/// Each image shows another part of the floor, and its plane takes another part of the pattern.
TEST_F(FixedError, IsLearnedFromHalvesOfFloors) {
  FloorCorrection correction{NoiseModel()};
  for (int i = 0; i < 40; ++i) {
    OwnedDepth<float> depth = sense(upOf(0.6 + 0.005 * i, 0.004 * i - 0.1), 0.8, 1.0, 0.0, 1);
    const int hidden = i % 4;  // one half of the columns, or of the rows
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) {
        const bool hide = hidden < 2 ? (u < 320) == (hidden == 0) : (v < 240) == (hidden == 2);
        if (hide) depth.at(u, v) = 0.0F;
      }
    }
    correction.add(depth.view(), camera_, detector_.detect(depth.view(), camera_));
  }
  const DepthCorrection::Grid learned = correction.learn().grid;
  DepthCorrection::Grid left = learned;
  for (int row = 0; row < 15; ++row) {
    for (int column = 0; column < 20; ++column) {
      left.inverse_depth[static_cast<std::size_t>(row * 20 + column)] -=
          pattern(32.0 * column + 15.5, 32.0 * row + 15.5);
    }
  }
  RecordProperty("left", std::to_string(notAffine(left)));
  EXPECT_LT(notAffine(left), 0.0005);
}

TEST_F(FixedError, IsZeroWhereNoFloorWasSeen) {
  FloorCorrection correction{NoiseModel()};
  for (int i = 0; i < 12; ++i) {
    OwnedDepth<float> depth = sense(upOf(0.6, 0.02 * i - 0.1), 0.8 + 0.02 * i, 1.0, 0.0, 1);
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 160; ++u) depth.at(u, v) = 0.0F;
    }
    correction.add(depth.view(), camera_, detector_.detect(depth.view(), camera_));
  }
  const DepthCorrection::Grid grid = correction.learn().grid;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < 5; ++column) {
      ASSERT_EQ(grid.inverse_depth[static_cast<std::size_t>(row * 20 + column)], 0.0) << column;
    }
  }
  EXPECT_NE(grid.inverse_depth[10 * 20 + 10], 0.0);
}

/// What turns planes into planes is not learned: on average over the views that it was learned
/// from, the planes of images without errors stay where they are. (Each by itself shows another
/// part of the pattern, and moves by what of that is affine.) The pattern moves depth by up to 28
/// mm at 2 m.
TEST_F(FixedError, LeavesExactPlanesWhereTheyAre) {
  FloorCorrection learner{NoiseModel()};
  add(learner, 30, 1.0, 0.0);
  DepthCorrection correction(learner.learn().grid);
  Eigen::Vector3d moved_normal = Eigen::Vector3d::Zero();
  double moved = 0.0;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> height(0.6, 1.4), pitch(0.5, 0.9), roll(-0.2, 0.2);
  constexpr int kViews = 30;
  for (int i = 0; i < kViews; ++i) {
    const Eigen::Vector3d up = upOf(pitch(generator), roll(generator));
    const double distance = height(generator);
    const OwnedDepth<float> exact = planeDepth(camera_, up, distance);
    const Detection& detection = detector_.detect(correction.correct(exact.view()), camera_);
    ASSERT_TRUE(detection.found());
    moved_normal += (detection.normal - up) / kViews;
    moved += (detection.distance - distance) / kViews;
  }
  RecordProperty("angle_degrees", std::to_string(moved_normal.norm() / kDegree));
  RecordProperty("height_mm", std::to_string(1e3 * moved));
  EXPECT_LT(moved_normal.norm(), 0.15 * kDegree);
  EXPECT_LT(std::abs(moved), 0.002);
}

/// @param why that the sentence has to say.
void expectRefusal(const FloorCorrection& correction, const std::string& why) {
  try {
    correction.learn();
    ADD_FAILURE() << "expected to be refused";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST_F(FixedError, ThatIsNoneIsRefused) {
  FloorCorrection correction{NoiseModel()};
  add(correction, 20, 0.0, 0.002);
  expectRefusal(correction, "not fixed");
}

TEST_F(FixedError, NeedsTenImages) {
  FloorCorrection correction{NoiseModel()};
  add(correction, 9, 1.0, 0.0);
  const OwnedDepth<float> nothing(640, 480);
  correction.add(nothing.view(), camera_, detector_.detect(nothing.view(), camera_));
  EXPECT_EQ(correction.images(), 9U);
  expectRefusal(correction, "at least 10");
  const OwnedDepth<float> square = planeDepth(testCamera(480, 480), upOf(0.6), 1.0);
  EXPECT_THROW(correction.add(square.view(), testCamera(480, 480),
                              detector_.detect(square.view(), testCamera(480, 480))),
               std::runtime_error);
}

TEST(CorrectionFile, IsReadAsItWasWritten) {
  const std::string file =
      (std::filesystem::temp_directory_path() / "floor_correction_test.yaml").string();
  FloorCorrection::Result learned;
  learned.grid = {2, 2, {0.001, -0.0025, 0.0, 0.03}};
  learned.images = 12;
  saveDepthCorrection(file, learned);
  const DepthCorrection correction = loadDepthCorrection(file);
  EXPECT_EQ(correction.grid().columns, 2);
  EXPECT_EQ(correction.grid().inverse_depth, learned.grid.inverse_depth);
  const auto refused = [&](const std::string& content, const std::string& what) {
    std::ofstream(file) << content;
    try {
      loadDepthCorrection(file);
      ADD_FAILURE() << content;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
    }
  };
  refused("columns: 2\nrows: 2\n", "inverse_depth");
  refused("columns: 2\nrows: 2\ninverse_depth: [0, 0, 0]\n", "3");
  refused("columns: x\nrows: 2\ninverse_depth: [0, 0]\n", "");
  refused("columns: 1\nrows: 1\ninverse_depth: [.nan]\n", "0.1");
  refused("- 1\n- 2\n", "columns");
  refused("", "columns");
  std::filesystem::remove(file);
  EXPECT_THROW(loadDepthCorrection(file), std::runtime_error);
  EXPECT_THROW(saveDepthCorrection("/nowhere/c.yaml", learned), std::runtime_error);
}

/// By five folds of neighbouring images: the halves of those that a correction was not learned from
/// agree better.
TEST(RealCorrection, HalvesWhatTheHalvesOfAnXtionsImagesDifferBy) {
  const ReferenceSet set = loadCabinet();
  if (set.images.empty()) GTEST_SKIP() << "no recordings in " << recordingsFolder();
  const ReferenceSet corrected = correctByFolds(set, Parameters());
  std::vector<double> angles, heights, angles_before, heights_before;
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    const HalfDifference before = compareHalves(set, set.images[i], Parameters());
    const HalfDifference after = compareHalves(corrected, corrected.images[i], Parameters());
    ASSERT_TRUE(before.found && after.found);
    angles_before.push_back(before.angle);
    heights_before.push_back(before.height);
    angles.push_back(after.angle);
    heights.push_back(after.height);
  }
  RecordProperty("degrees", std::to_string(quantile(angles, 0.5) / kDegree));
  RecordProperty("millimetres", std::to_string(1e3 * quantile(heights, 0.5)));
  RecordProperty("degrees_before", std::to_string(quantile(angles_before, 0.5) / kDegree));
  RecordProperty("millimetres_before", std::to_string(1e3 * quantile(heights_before, 0.5)));
  EXPECT_LE(quantile(angles, 0.5), 0.5 * quantile(angles_before, 0.5));
  EXPECT_LE(quantile(heights, 0.5), 0.5 * quantile(heights_before, 0.5));
}

TEST(RealCorrection, IsRefusedForARealSense) {
  for (const auto& load : {loadRobotLab, loadLowRobot}) {
    const ReferenceSet set = load();
    if (set.images.empty()) GTEST_SKIP() << "no recordings in " << recordingsFolder();
    FloorCorrection learner{NoiseModel()};
    Parameters parameters;
    parameters.range_min = set.range_min;
    parameters.range_max = set.range_max;
    DominantPlaneDetector detector(parameters);
    for (const ReferenceImage& image : set.images) {
      learner.add(set.view(image), set.camera, detector.detect(set.view(image), set.camera));
    }
    expectRefusal(learner, "not fixed");
  }
}

}  // namespace
}  // namespace dominant_plane_detection
