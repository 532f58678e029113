#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/count_allocations.h"
#include "support/detector_fixture.h"

namespace dominant_plane_detection {
namespace {

INSTANTIATE_TEST_SUITE_P(Algorithms, DetectorAlgorithm,
                         testing::Values(Algorithm::kGrid, Algorithm::kKdtree));

TEST_P(DetectorAlgorithm, FindsANoisyFloorWhereItIs) {
  const CameraModel camera = testCamera();
  const auto depth = inMillimetres(planeDepth(camera, kUp, kHeight), 1.425e-3);
  DominantPlaneDetector detector(parameters_);
  const Detection& detection = detector.detect(depth.view(), camera);
  ASSERT_EQ(detection.state, State::kFound) << detection.reason;
  EXPECT_TRUE(detection.reason.empty());
  EXPECT_LT(angle(detection.normal, kUp), 0.001);
  EXPECT_NEAR(detection.distance, kHeight, 0.001);
  EXPECT_NEAR(detection.normal.norm(), 1.0, 1e-9);
  EXPECT_GT(detection.inlierShare(), 0.99);
  EXPECT_LT(std::sqrt(detection.mean_square_error), 0.005);
  EXPECT_EQ(detection.up_source, UpSource::kFixed);
}

TEST_P(DetectorAlgorithm, LabelsTheFloorBehindAnObstacle) {
  const CameraModel camera = testCamera();
  const auto depth = inMillimetres(cutFloor(camera));
  DominantPlaneDetector detector(parameters_);
  const Detection& detection = detector.detect(depth.view(), camera);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_LT(angle(detection.normal, kUp), 0.001);
  EXPECT_EQ(detection.label(320, 220), Label::kGround);    // behind, 2 m away
  EXPECT_EQ(detection.label(320, 270), Label::kObstacle);  // the box
  EXPECT_EQ(detection.label(320, 450), Label::kGround);    // in front
}

TEST_P(DetectorAlgorithm, DegenerateImagesAreResultsWithAReason) {
  DominantPlaneDetector detector(parameters_);
  const auto expect = [&](const OwnedDepth<std::uint16_t>& depth, State state) {
    const Detection& detection =
        detector.detect(depth.view(), testCamera(depth.width, depth.height));
    EXPECT_EQ(stateName(detection.state), stateName(state)) << detection.reason;
    EXPECT_FALSE(detection.reason.empty());
    EXPECT_TRUE(std::isnan(detection.distance) && std::isnan(detection.normal.x()));
    EXPECT_EQ(detection.inliers, 0U);
    EXPECT_EQ(detection.labels, std::vector<std::uint8_t>(depth.pixels.size(), 0));
  };
  expect(OwnedDepth<std::uint16_t>(640, 480), State::kNoDepth);
  OwnedDepth<std::uint16_t> far(640, 480);
  far.pixels.assign(far.pixels.size(), 65535);
  expect(far, State::kNoDepth);
  OwnedDepth<std::uint16_t> one(1, 1);
  one.at(0, 0) = 1000;
  expect(one, State::kTooFewPoints);
  OwnedDepth<std::uint16_t> two(640, 480);
  two.at(100, 400) = two.at(300, 420) = 1000;
  expect(two, State::kTooFewPoints);
}

TEST_P(DetectorAlgorithm, OddSizesWork) {
  parameters_.subsampling = 1;
  DominantPlaneDetector detector(parameters_);
  for (const int width : {161, 320, 333}) {
    const CameraModel camera = testCamera(width, 121);
    const auto depth = inMillimetres(planeDepth(camera, kUp, kHeight), 1.425e-3);
    const Detection& detection = detector.detect(depth.view(), camera);
    ASSERT_TRUE(detection.found()) << detection.reason;
    EXPECT_LT(angle(detection.normal, kUp), 0.005);
    EXPECT_NEAR(detection.distance, kHeight, 0.004);
  }
}

TEST_P(DetectorAlgorithm, FloatImagesWithEveryKindOfNumber) {
  const CameraModel camera = testCamera();
  OwnedDepth<float> depth = planeDepth(camera, kUp, kHeight);
  for (std::size_t i = 0; i < depth.pixels.size(); i += 9) {
    const float odd[] = {
        std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        -std::numeric_limits<float>::infinity(), -1.0F,
        std::numeric_limits<float>::max(),       std::numeric_limits<float>::denorm_min()};
    depth.pixels[i] = odd[(i / 9) % 6];
  }
  DominantPlaneDetector detector(parameters_);
  const Detection& detection = detector.detect(depth.view(), camera);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_LT(angle(detection.normal, kUp), 1e-4);
  EXPECT_NEAR(detection.distance, kHeight, 1e-4);
  EXPECT_EQ(detection.label(0, 479), detection.label(1, 479));
}

TEST_P(DetectorAlgorithm, TheResultDependsOnNothingThatWasSeenBefore) {
  const CameraModel camera = testCamera();
  const auto first = inMillimetres(cutFloor(camera), 1.425e-3, 1);
  const auto second = inMillimetres(planeDepth(camera, upOf(0.8), 0.5), 1.425e-3, 2);
  DominantPlaneDetector fresh(parameters_), used(parameters_);
  const Detection expected = fresh.detect(first.view(), camera);
  used.detect(second.view(), camera);
  used.detect(OwnedDepth<std::uint16_t>(64, 48).view(), testCamera(64, 48));
  const Detection& again = used.detect(first.view(), camera);
  EXPECT_EQ(again.normal, expected.normal);
  EXPECT_EQ(again.distance, expected.distance);
  EXPECT_EQ(again.labels, expected.labels);
}

TEST(Detector, PlanesThatAreNoGround) {
  const CameraModel camera = testCamera();
  const auto wall = inMillimetres(planeDepth(camera, {0.0, 0.0, -1.0}, 2.0));
  DominantPlaneDetector detector;
  EXPECT_STREQ(stateName(detector.detect(wall.view(), camera).state), "TOO_TILTED");
  const auto floor = inMillimetres(planeDepth(camera, kUp, kHeight));
  Prior prior;
  prior.height_range = Prior::HeightRange{1.0, 2.0};
  const Detection& high = detector.detect(floor.view(), camera, prior);
  EXPECT_STREQ(stateName(high.state), "OUT_OF_HEIGHT_RANGE");
  EXPECT_EQ(high.reason,
            "The camera is 0.800 m over the largest plane, expected 1.000 to 2.000 m.");
  Parameters parameters;
  parameters.min_share = 1.0;
  OwnedDepth<std::uint16_t> half = floor;
  for (int v = 240; v < 300; ++v) {
    for (int u = 0; u < 640; ++u)
      half.at(u, v) = static_cast<std::uint16_t>(600 + 90 * ((u * 7 + v * 13) % 11));
  }
  DominantPlaneDetector strict(parameters);
  EXPECT_STREQ(stateName(strict.detect(half.view(), camera).state), "TOO_SMALL");
  OwnedDepth<std::uint16_t> chaos(640, 480);
  std::mt19937 generator(3);
  for (auto& pixel : chaos.pixels) pixel = static_cast<std::uint16_t>(600 + generator() % 3000);
  EXPECT_STREQ(stateName(detector.detect(chaos.view(), camera).state), "NO_REGION");
}

TEST(Detector, ImagesHaveAtMost8192PixelsASide) {
  DominantPlaneDetector detector;
  const auto stateOf = [&](int width, int height) {
    const OwnedDepth<std::uint16_t> depth(width, height);
    const Detection& detection = detector.detect(depth.view(), testCamera(width, height));
    EXPECT_EQ(detection.image_width, detection.state == State::kBadInput ? 0 : width);
    EXPECT_EQ(detection.image_height, detection.state == State::kBadInput ? 0 : height);
    return detection.state;
  };
  EXPECT_EQ(stateOf(8192, 1), State::kNoDepth);
  EXPECT_EQ(stateOf(1, 8192), State::kNoDepth);
  EXPECT_EQ(stateOf(8193, 1), State::kBadInput);
  EXPECT_EQ(stateOf(1, 8193), State::kBadInput);
}

TEST(Detector, UpMayHaveAnyLengthThatIsOne) {
  const CameraModel camera = testCamera();
  const auto floor = inMillimetres(planeDepth(camera, kUp, kHeight));
  DominantPlaneDetector detector;
  for (const double length : {1.1e-3, 1.0, 1e6}) {
    Prior prior;
    prior.expected_up = length * kUp.normalized();
    EXPECT_TRUE(detector.detect(floor.view(), camera, prior).found()) << length;
  }
  Prior none;
  none.expected_up = 0.9e-3 * kUp.normalized();
  EXPECT_EQ(detector.detect(floor.view(), camera, none).state, State::kBadInput);
}

TEST(Detector, ThePriorSaysWhereUpIs) {
  const CameraModel camera = testCamera();
  const auto wall = inMillimetres(planeDepth(camera, {0.0, 0.0, -1.0}, 2.0));
  DominantPlaneDetector detector;
  Prior prior;
  prior.expected_up = Eigen::Vector3d(0.0, 0.0, -3.0);
  prior.up_source = UpSource::kImu;
  const Detection& detection = detector.detect(wall.view(), camera, prior);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_NEAR(detection.distance, 2.0, 1e-3);
  EXPECT_EQ(detection.up_source, UpSource::kImu);
}

/// A floor over an eighth of the image, beyond a table that fills the rest.
OwnedDepth<std::uint16_t> tableBeforeFloor(const CameraModel& camera) {
  OwnedDepth<float> depth = planeDepth(camera, kUp, 0.4);
  OwnedDepth<float> floor = planeDepth(camera, kUp, 1.1);
  for (int v = 240; v < 400; ++v) {
    for (int u = 400; u < 640; ++u) depth.at(u, v) = floor.at(u, v);
  }
  return inMillimetres(depth);
}

TEST(Detector, KnowingUpTheLowestLevelPlaneIsTheGround) {
  const CameraModel camera = testCamera();
  const auto depth = tableBeforeFloor(camera);
  const auto distance = [&](Preference prefer, UpSource source) {
    Parameters parameters;
    parameters.prefer = prefer;
    parameters.expected_up = kUp;
    Prior prior;
    if (source != UpSource::kFixed) prior.expected_up = kUp;
    prior.up_source = source;
    return DominantPlaneDetector(parameters).detect(depth.view(), camera, prior).distance;
  };
  for (const UpSource source : {UpSource::kImu, UpSource::kTf}) {
    EXPECT_NEAR(distance(Preference::kAuto, source), 1.1, 2e-3);
    EXPECT_NEAR(distance(Preference::kLargest, source), 0.4, 2e-3);
    EXPECT_NEAR(distance(Preference::kLowest, source), 1.1, 2e-3);
  }
  EXPECT_NEAR(distance(Preference::kAuto, UpSource::kFixed), 0.4, 2e-3);
  EXPECT_NEAR(distance(Preference::kAuto, UpSource::kNone), 0.4, 2e-3);
  EXPECT_NEAR(distance(Preference::kLowest, UpSource::kFixed), 1.1, 2e-3);
}

/// Up decides what is level, not where the search begins.
TEST(Detector, HowExactlyUpIsKnownChangesNothing) {
  const CameraModel camera = testCamera();
  const auto depth = tableBeforeFloor(camera);
  std::vector<Effort> efforts;
  for (const double roll : {0.0, 0.12, -0.12}) {
    DominantPlaneDetector detector;
    Prior prior;
    // The roll is 0.39 where two of the directions meet that seeds could be drawn by.
    prior.expected_up = Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) * upOf(0.5, 0.35);
    prior.up_source = UpSource::kImu;
    prior.up_error = 0.5;
    const Detection& detection = detector.detect(depth.view(), camera, prior);
    EXPECT_NEAR(detection.distance, 1.1, 2e-3);
    efforts.push_back(detection.effort);
  }
  for (const Effort& effort : efforts) {
    EXPECT_EQ(effort.tests, efforts.front().tests);
    EXPECT_EQ(effort.joined, efforts.front().joined);
    EXPECT_EQ(effort.seeds, efforts.front().seeds);
  }
}

TEST(Detector, TheExpectedHeightSaysWhichLevelPlane) {
  const CameraModel camera = testCamera();
  const auto depth = tableBeforeFloor(camera);
  DominantPlaneDetector detector;
  for (const double height : {0.4, 1.1}) {
    Prior prior;
    prior.expected_up = kUp;
    prior.up_source = UpSource::kTf;
    prior.expected_height = Prior::ExpectedHeight{height + 0.05, 0.1};
    EXPECT_NEAR(detector.detect(depth.view(), camera, prior).distance, height, 2e-3);
  }
}

/// The lowest plane has to be level: within 10 degrees and what up may be wrong by.
TEST(Detector, WhatIsTooTiltedToBeLevelIsNoGround) {
  const CameraModel camera = testCamera();
  const auto floor = inMillimetres(planeDepth(camera, kUp, kHeight));
  DominantPlaneDetector detector;
  const auto found = [&](double tilt, double error) {
    Prior prior;
    prior.expected_up = Eigen::AngleAxisd(tilt, kUp.unitOrthogonal()) * kUp.normalized();
    prior.up_source = UpSource::kImu;
    prior.up_error = error;
    return detector.detect(floor.view(), camera, prior).found();
  };
  EXPECT_TRUE(found(0.17, 0.0));
  EXPECT_FALSE(found(0.18, 0.0));
  EXPECT_TRUE(found(0.27, 0.1));
  EXPECT_FALSE(found(0.28, 0.1));
}

TEST(Detector, APredictionWithAWeightSmoothsTheResult) {
  const CameraModel camera = testCamera();
  const auto depth = inMillimetres(planeDepth(camera, kUp, kHeight));
  DominantPlaneDetector detector;
  const Detection first = detector.detect(depth.view(), camera);
  EXPECT_FALSE(first.tracked);
  Prior prior;
  prior.predicted_plane =
      Prior::PredictedPlane{first.normal, first.distance + 0.004, first.covariance, 0.75};
  const Detection& smoothed = detector.detect(depth.view(), camera, prior);
  EXPECT_TRUE(smoothed.tracked);
  EXPECT_NEAR(smoothed.distance, first.distance + 0.003, 1e-4);
  EXPECT_EQ(smoothed.inliers, first.inliers);
  prior.predicted_plane->weight = 0.0;
  EXPECT_NEAR(detector.detect(depth.view(), camera, prior).distance, first.distance, 1e-4);
  // An image that shows none of it.
  const auto wall = inMillimetres(planeDepth(camera, {0.0, 0.0, -1.0}, 2.0));
  EXPECT_FALSE(detector.detect(wall.view(), camera, prior).tracked);
}

TEST(Detector, BadInputIsExplained) {
  const CameraModel camera = testCamera();
  const auto depth = inMillimetres(planeDepth(camera, kUp, kHeight));
  DominantPlaneDetector detector;
  const auto expectBad = [&](const DepthView& view, const CameraModel& model, const char* word,
                             const Prior& prior = Prior()) {
    const Detection& detection = detector.detect(view, model, prior);
    EXPECT_STREQ(stateName(detection.state), "BAD_INPUT");
    EXPECT_NE(detection.reason.find(word), std::string::npos) << detection.reason;
  };
  expectBad(DepthView(), camera, "empty");
  expectBad(depth.view(), testCamera(320, 240), "320 x 240");
  expectBad(depth.view(), CameraModel(), "focal length");
  DepthView view = depth.view();
  view.step = 100;
  expectBad(view, camera, "step");
  Prior prior;
  prior.expected_up = Eigen::Vector3d::Zero();
  expectBad(depth.view(), camera, "up direction", prior);
  const double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const Prior::HeightRange range : {Prior::HeightRange{kNaN, 1.0}, {0.0, kNaN}, {2.0, 1.0}}) {
    Prior heights;
    heights.height_range = range;
    expectBad(depth.view(), camera, "height range", heights);
  }
  Prior error;
  error.up_error = kNaN;
  expectBad(depth.view(), camera, "error of up", error);
  for (const auto& height : {Prior::ExpectedHeight{0.0, 0.1}, {1.0, kNaN}}) {
    Prior expected;
    expected.expected_height = height;
    expectBad(depth.view(), camera, "positive height", expected);
  }
  for (const auto& plane : {Prior::PredictedPlane{kUp, kNaN},
                            {1.01 * kUp.normalized(), 1.0},
                            {kUp.normalized(), 1.0, unknownCovariance(), 1.0},
                            {kUp.normalized(), -1.0}}) {
    Prior predicted;
    predicted.predicted_plane = plane;
    expectBad(depth.view(), camera, "predicted plane", predicted);
  }
  for (const float unit : {0.0F, -0.001F, std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity()}) {
    view = depth.view();
    view.metres_per_unit = unit;
    expectBad(view, camera, "metres_per_unit");
  }
  // Sizes out of broken headers cost neither memory nor time.
  view = DepthView();
  view.width = view.height = 2000000000;
  expectBad(view, camera, "empty");
  view = depth.view();
  view.width = view.height = 100000;
  expectBad(view, camera, "8192");
  EXPECT_TRUE(detector.detect(view, camera).labels.empty());
  EXPECT_EQ(detector.detect(view, camera).image_width, 0);
  EXPECT_EQ(detector.detect(view, camera).image_height, 0);
  // An image that is there is black.
  EXPECT_EQ(detector.detect(depth.view(), testCamera(320, 240)).labels,
            std::vector<std::uint8_t>(640 * 480, 0));
}

TEST(Detector, AWarmDetectorAllocatesNothing) {
  const CameraModel camera = testCamera();
  const auto floor = inMillimetres(cutFloor(camera), 1.425e-3);
  const auto wall = inMillimetres(planeDepth(camera, {0.0, 0.0, -1.0}, 2.0));
  const OwnedDepth<std::uint16_t> nothing(640, 480);
  DominantPlaneDetector detector;
  const auto detectAll = [&] {
    ASSERT_TRUE(detector.detect(floor.view(), camera).found());
    ASSERT_EQ(detector.detect(wall.view(), camera).state, State::kTooTilted);
    ASSERT_EQ(detector.detect(nothing.view(), camera).state, State::kNoDepth);
  };
  detectAll();
  const std::size_t before = allocationCount();
  detectAll();
  EXPECT_EQ(allocationCount() - before, 0U);
}

/// The first image has nothing on its floor, the second a plate of 2 cm.
TEST(Detector, AnObstacleThatComesLaterAllocatesNothing) {
  const CameraModel camera = testCamera();
  const OwnedDepth<float> floor = planeDepth(camera, upOf(0.6), 0.9);
  OwnedDepth<float> plate = floor;
  for (int v = 250; v < 330; ++v) {
    for (int u = 280; u < 380; ++u) plate.at(u, v) *= (0.9F - 0.02F) / 0.9F;
  }
  DominantPlaneDetector detector;
  ASSERT_TRUE(detector.detect(floor.view(), camera).found());
  const std::size_t before = allocationCount();
  const Detection& detection = detector.detect(plate.view(), camera);
  EXPECT_EQ(allocationCount() - before, 0U);
  EXPECT_EQ(detection.label(330, 290), Label::kObstacle);
}

TEST(Detector, AHoleThatComesLaterAllocatesNothing) {
  const CameraModel camera = testCamera();
  const OwnedDepth<float> floor = planeDepth(camera, upOf(0.6), 0.9);
  OwnedDepth<float> holed = floor;
  for (int v = 250; v < 400; ++v) {
    for (int u = 200; u < 480; ++u) holed.at(u, v) = 0.0F;
  }
  DominantPlaneDetector detector;
  ASSERT_TRUE(detector.detect(floor.view(), camera).found());
  const std::size_t before = allocationCount();
  const Detection& detection = detector.detect(holed.view(), camera);
  EXPECT_EQ(allocationCount() - before, 0U);
  EXPECT_EQ(detection.label(330, 300), Label::kMissingGround);
}

}  // namespace
}  // namespace dominant_plane_detection
