// What a depth image itself tells: of rendered scenes with a sensor's noise and shadows.

#include "doctor/image_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "doctor/no_plane_trials.h"
#include "support/finding.h"
#include "support/synthetic_depth.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {
namespace {

using Millimetres = OwnedDepth<std::uint16_t>;

/// A robot before a bin, as a Kinect sees it.
const Millimetres& binImage() {
  static const Millimetres kImage = [] {
    const Scene scene = loadScene(DPD_SOURCE "/scenes/rubbish_bin.yaml");
    const auto rendering = Renderer(scene).render(scene.path.at(1.0).pose(), {true, false});
    Millimetres image(rendering.width, rendering.height);
    image.pixels = senseDepth(rendering, scene.noise, 1);
    return image;
  }();
  return kImage;
}

CameraModel binCamera() { return loadScene(DPD_SOURCE "/scenes/rubbish_bin.yaml").camera; }

Millimetres mirrored(Millimetres image) {
  for (int v = 0; v < image.height; ++v) {
    std::reverse(&image.at(0, v), &image.at(0, v) + image.width);
  }
  return image;
}

Millimetres turned(Millimetres image) {
  std::reverse(image.pixels.begin(), image.pixels.end());
  return image;
}

Millimetres times(Millimetres image, double factor) {
  for (std::uint16_t& z : image.pixels) {
    z = static_cast<std::uint16_t>(std::min(65535.0, factor * z + 0.5));
  }
  return image;
}

/// @return what ten looks at an image tell.
template <typename Image>
Findings study(const Image& image, const Parameters& parameters = Parameters(),
               const Prior& prior = Prior()) {
  ImageStudy study(parameters);
  for (int i = 0; i < 10; ++i) study.add(image.view(), binCamera(), prior);
  return study.findings();
}

TEST(ImageRules, NothingIsWrongWithAGoodImage) { EXPECT_TRUE(study(binImage()).empty()); }

TEST(ImageRules, AWrongUnitIsToldByTheReadings) {
  expectOnly(study(times(binImage(), 5.0)), Code::kDepthScale,
             {"Multiplied by 0.2", "1/5000 m", "--depth-scale"});
  expectOnly(study(times(binImage(), 10.0)), Code::kDepthScale, {"Multiplied by 0.1", "0.1 mm"});
  expectOnly(study(times(binImage(), 0.1)), Code::kDepthScale, {"by 10", "in centimetres"});
  expectOnly(study(times(binImage(), 0.2)), Code::kDepthScale, {"by 5", "units of 5 mm"});
  expectOnly(study(times(binImage(), 0.001)), Code::kDepthScale, {"by 1000", "in metres"});
  OwnedDepth<float> floats(binImage().width, binImage().height);
  std::copy(binImage().pixels.begin(), binImage().pixels.end(), floats.pixels.begin());
  expectOnly(study(floats), Code::kDepthScale, {"by 0.001", "in millimetres where metres"});
}

TEST(ImageRules, SpreadIsThatOfTheReadings) {
  Millimetres image(640, 480);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      image.at(u, v) = static_cast<std::uint16_t>(v < 96 ? 1000 : v < 384 ? 2005 : 4000);
    }
  }
  const DepthSpread spread = spreadOf(image.view());
  EXPECT_NEAR(spread.near, 1.0, 1e-4);
  EXPECT_NEAR(spread.median, 2.005, 1e-4);
  EXPECT_NEAR(spread.far, 4.0, 1e-4);
  EXPECT_TRUE(spread.multiples_of_5);
  EXPECT_TRUE(isPlausible(spread));
  EXPECT_FALSE(spreadOf(binImage().view()).multiples_of_5);
  EXPECT_FALSE(spreadOf(Millimetres(640, 480).view()).known);
}

TEST(ImageRules, WhatACameraCanSeeIsPlausible) {
  const auto plausible = [](double near, double median, double far) {
    return isPlausible({near, median, far, false, true});
  };
  EXPECT_TRUE(plausible(0.32, 0.9, 12.5)) << "a low RealSense, with noise from far away";
  EXPECT_TRUE(plausible(2.5, 4.0, 8.0)) << "a hall";
  EXPECT_FALSE(plausible(2.5, 6.0, 15.0)) << "nothing near, and much farther than it sees";
  EXPECT_FALSE(plausible(0.15, 0.4, 1.0));
  EXPECT_FALSE(plausible(0.22, 0.26, 0.5));
  EXPECT_FALSE(plausible(1.0, 11.0, 15.0));
  EXPECT_FALSE(isPlausible({4.0, 5.0, 8.0, true, true})) << "all far, in steps of 5 mm";
  EXPECT_TRUE(isPlausible({1.0, 2.0, 4.0, true, true})) << "a coarse camera";
  EXPECT_TRUE(isPlausible(DepthSpread()));
}

TEST(ImageRules, AMirroredImageIsToldByItsShadows) {
  const ShadowSides sides = shadowSides(binImage().view(), binCamera());
  EXPECT_GT(sides.left, 20U);
  EXPECT_GT(sides.left, 4 * sides.right);
  const ShadowSides other = shadowSides(mirrored(binImage()).view(), binCamera());
  EXPECT_GT(other.right, 4 * other.left);
  expectOnly(study(mirrored(binImage())), Code::kMirrored, {"mirrored", "mirroring off"});
}

TEST(ImageRules, OnlyOverwhelmingEvidenceIsOfAMirror) {
  EXPECT_FALSE(findMirrored({0, 199}));
  EXPECT_TRUE(findMirrored({0, 200}));
  EXPECT_TRUE(findMirrored({50, 200}));
  EXPECT_FALSE(findMirrored({51, 200}));
  EXPECT_FALSE(findMirrored({1000, 10}));
}

TEST(ImageRules, GapsThatNoShadowMakesAreNotCounted) {
  CameraModel camera = testCamera(640, 480);
  // 1 m and 2 m: a shadow of 75 mm baseline is 525 * 0.075 / 2 = 19.7 px wide.
  const auto sidesOf = [&](int width, int begin) {
    Millimetres image(640, 480);
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) {
        const bool gap = u >= begin && u < begin + width;
        image.at(u, v) = static_cast<std::uint16_t>(gap ? 0 : u < begin ? 2000 : 1000);
      }
    }
    return shadowSides(image.view(), camera);
  };
  EXPECT_EQ(sidesOf(20, 300).left, 240U);
  EXPECT_EQ(sidesOf(20, 300).right, 0U);
  EXPECT_EQ(sidesOf(60, 300).left, 0U) << "too wide";
  EXPECT_EQ(sidesOf(5, 300).left, 0U) << "too narrow";
  EXPECT_EQ(sidesOf(20, 2).left, 0U) << "at the border";
  EXPECT_EQ(sidesOf(20, 619).left, 0U) << "at the other border";
}

TEST(ImageRules, GroundBeyondTheRangeIsToldByALongerOne) {
  Parameters parameters;
  parameters.range_max = 0.7;
  expectOnly(study(binImage(), parameters), Code::kRangeMax,
             {"range_max 1 m instead of 0.7 m", "Set range_max to 1"});
  parameters.range_max = 4.0;
  const auto high = inMillimetres(planeDepth(binCamera(), upOf(0.9), 5.0));
  expectOnly(study(high, parameters), Code::kRangeMax, {"Set range_max to 6"});
}

TEST(ImageRules, ACameraUpsideDownIsToldByTheGroundAbove) {
  expectOnly(study(turned(binImage())), Code::kUpsideDown, {"upside down", "expected_up_y"});
  Parameters parameters;
  parameters.expected_up = {0.0, 1.0, 0.0};
  expectOnly(study(binImage(), parameters), Code::kUpsideDown, {"upside down"});
}

TEST(ImageRules, UpsideDownBlamesWhatUpIsKnownBy) {
  Prior prior;
  prior.expected_up = Eigen::Vector3d(0.0, std::cos(0.22), -std::sin(0.22));
  prior.up_source = UpSource::kTf;
  expectOnly(study(binImage(), Parameters(), prior), Code::kUpsideDown, {"tf has the camera"});
  prior.up_source = UpSource::kImu;
  expectOnly(study(binImage(), Parameters(), prior), Code::kUpsideDown, {"use_imu"});
}

TEST(ImageRules, NoCauseIsToldThatNothingProves) {
  // A wall: neither up nor range makes it the ground.
  const auto wall = inMillimetres(planeDepth(binCamera(), {0.0, 0.0, -1.0}, 1.5));
  EXPECT_TRUE(study(wall).empty());
  EXPECT_TRUE(study(times(wall, 5.0)).empty()) << "odd, but no unit gives it a plane";
  EXPECT_TRUE(study(Millimetres(640, 480)).empty());
}

TEST(ImageRules, NowAndThenNoPlaneIsNothing) {
  ImageStudy study{Parameters()};
  const Millimetres down = turned(binImage());
  for (int i = 0; i < 3; ++i) study.add(binImage().view(), binCamera());
  for (int i = 0; i < 8; ++i) study.add(down.view(), binCamera());
  EXPECT_EQ(study.planes(), 3U);
  EXPECT_FALSE(hasCode(study.findings(), Code::kUpsideDown)) << "3 of 11";
  study.add(down.view(), binCamera());
  study.add(down.view(), binCamera());
  EXPECT_TRUE(hasCode(study.findings(), Code::kUpsideDown)) << "3 of 13";
}

/// Half of the images without a plane are of walls, which turning them does not change.
TEST(ImageRules, WhatHealsHalfOfTheImagesIsNotTheCause) {
  ImageStudy study{Parameters()};
  const Millimetres down = turned(binImage());
  const auto wall = inMillimetres(planeDepth(binCamera(), {0.0, 0.0, -1.0}, 1.5));
  for (int i = 0; i < 4; ++i) {
    study.add(down.view(), binCamera());
    study.add(wall.view(), binCamera());
  }
  EXPECT_EQ(study.planes(), 0U);
  EXPECT_FALSE(hasCode(study.findings(), Code::kUpsideDown)) << "4 of 8";
  study.add(down.view(), binCamera());
  EXPECT_TRUE(hasCode(study.findings(), Code::kUpsideDown)) << "5 of 9";
}

/// A level camera 1.5 m up in a hall: the floor begins 3.6 m away, and a wall is at 12 m.
Millimetres hallImage() {
  Millimetres image = inMillimetres(planeDepth(binCamera(), upOf(0.0), 1.5));
  for (std::uint16_t& z : image.pixels) z = z == 0 || z > 12000 ? 12000 : z;
  return image;
}

TEST(ImageRules, AHallThatShowsItsFloorIsNoWrongUnit) {
  Parameters parameters;
  parameters.range_max = 8.0;
  const DepthSpread spread = spreadOf(hallImage().view());
  ASSERT_FALSE(isPlausible(spread));
  ASSERT_FALSE(isImpossible(spread));
  EXPECT_TRUE(study(hallImage(), parameters).empty());
}

TEST(ImageRules, AGripperBeforeTheCameraIsNoWrongUnit) {
  Millimetres image = binImage();
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < 80; ++u) image.at(u, v) = 150;
  }
  ASSERT_FALSE(isPlausible(spreadOf(image.view())));
  EXPECT_TRUE(study(image).empty());
}

/// A ceiling 0.8 m above a level camera, as of a passage.
TEST(ImageRules, ACeilingMayBeTheCauseToo) {
  const auto ceiling = inMillimetres(planeDepth(binCamera(), -upOf(0.0), 0.8));
  expectOnly(study(ceiling), Code::kUpsideDown, {"a ceiling alone"});
  Prior prior;
  prior.expected_up = upOf(0.0);
  prior.up_source = UpSource::kImu;
  expectOnly(study(ceiling, Parameters(), prior), Code::kUpsideDown, {"a ceiling alone"});
  prior.up_source = UpSource::kTf;
  expectOnly(study(ceiling, Parameters(), prior), Code::kUpsideDown, {"a ceiling alone"});
  prior.expected_height = {0.5, 0.125};
  EXPECT_TRUE(study(ceiling, Parameters(), prior).empty()) << "tf knows another height";
  prior.expected_height = {0.75, 0.125};
  expectOnly(study(ceiling, Parameters(), prior), Code::kUpsideDown, {"a ceiling alone"});
}

/// Looks at one image again and again, at the times of a clock of its own.
class NoPlaneTrialsTest : public testing::Test {
 protected:
  NoPlaneTrialsTest() { parameters_.expected_up = {0.0, 1.0, 0.0}; }

  void begin() {
    trials_ = NoPlaneTrials(parameters_, [this] {
      const double now = now_;
      now_ += round_;
      return now;
    });
  }
  /// @return the cause after an image without a plane.
  std::optional<Finding> see(double now) {
    now_ = now;
    Detection none;
    none.state = State::kTooTilted;
    trials_.add(binImage().view(), binCamera(), Prior(), none);
    return trials_.cause();
  }

  Parameters parameters_;
  NoPlaneTrials trials_{Parameters()};
  double now_ = 0.0;    // [s]
  double round_ = 0.0;  // [s] that trials take
};

TEST_F(NoPlaneTrialsTest, TryOnceASecondWhileThereIsNoPlane) {
  begin();
  EXPECT_FALSE(see(10.0));
  EXPECT_FALSE(see(10.9)) << "not a second yet";
  EXPECT_FALSE(see(11.0)) << "a single image tells nothing";
  EXPECT_FALSE(see(11.9));
  EXPECT_TRUE(see(12.0));
  Detection found;
  found.state = State::kFound;
  trials_.add(binImage().view(), binCamera(), Prior(), found);
  EXPECT_FALSE(trials_.cause()) << "with planes there is nothing to tell";
  EXPECT_FALSE(see(13.0));
}

TEST_F(NoPlaneTrialsTest, RestTwentyTimesAsLongAsTheyTake) {
  round_ = 0.5;
  begin();
  EXPECT_FALSE(see(10.0));
  EXPECT_FALSE(see(11.0)) << "the first one";
  EXPECT_FALSE(see(21.4));
  EXPECT_TRUE(see(21.5)) << "10 s after it";
  Detection found;
  found.state = State::kFound;
  trials_.add(binImage().view(), binCamera(), Prior(), found);
  for (const double now : {23.0, 32.9}) EXPECT_FALSE(see(now));
  EXPECT_EQ(now_, 33.4) << "planes in between do not hurry them";
}

TEST_F(NoPlaneTrialsTest, AreByTheGrid) {
  parameters_.algorithm = Algorithm::kKdtree;
  begin();
  EXPECT_FALSE(see(10.0));
  EXPECT_FALSE(see(11.0));
  EXPECT_TRUE(see(12.0));
  parameters_ = Parameters();  // the grid has a plane as it is: up is not to blame
  parameters_.algorithm = Algorithm::kKdtree;
  begin();
  for (const double now : {10.0, 11.0, 12.0, 13.0}) EXPECT_FALSE(see(now));
}

}  // namespace
}  // namespace dominant_plane_detection
