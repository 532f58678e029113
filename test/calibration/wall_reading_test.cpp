#include "calibration/wall_reading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <vector>

namespace dominant_plane_detection {
namespace {

constexpr int kWidth = 640, kHeight = 480;

/// An image of raw disparity, and what a reading makes of it.
class WallReadingTest : public testing::Test {
 protected:
  using Value = std::function<double(int u, int v)>;

  void add(const Value& value) {
    std::vector<std::uint16_t> pixels;
    std::normal_distribution<double> noise(0.0, 0.4);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const double raw = value(u, v);
        pixels.push_back(raw >= 2047.0
                             ? std::uint16_t{2047}
                             : static_cast<std::uint16_t>(std::lround(raw + noise(generator_))));
      }
    }
    DepthView view;
    view.data = pixels.data();
    view.width = kWidth;
    view.height = kHeight;
    view.step = 2 * kWidth;
    wall_.add(view);
  }
  std::string problem() const {
    try {
      wall_.mean();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  }

  std::mt19937 generator_{1};
  WallReading wall_;
};

TEST_F(WallReadingTest, FractionsOfARawValue) {
  for (int i = 0; i < 5; ++i) add([](int, int) { return 712.3; });
  EXPECT_EQ(wall_.images(), 5U);
  EXPECT_NEAR(wall_.mean(), 712.3, 0.02);
}

TEST_F(WallReadingTest, OfATiltedWallTheMiddle) {
  // What stands around it, and gaps in it, do not matter.
  add([](int u, int v) {
    if (u < 200 || v > 400) return 300.0;
    if (u % 7 == 0) return 2047.0;
    return 712.3 + 0.05 * (u - 319.5) - 0.03 * (v - 239.5);
  });
  EXPECT_NEAR(wall_.mean(), 712.3, 0.05);
}

TEST_F(WallReadingTest, ExplainsWhatIsNoWall) {
  EXPECT_NE(problem().find("no images"), std::string::npos);
  add([](int, int) { return 2047.0; });
  EXPECT_NE(problem().find("too few readings"), std::string::npos) << problem();
  wall_ = WallReading();
  add([](int u, int) { return u < 320 ? 700.0 : 720.0; });
  EXPECT_NE(problem().find("flat wall"), std::string::npos) << problem();
  wall_ = WallReading();
  for (int i = 0; i < 5; ++i) add([&](int, int) { return 700.0 + 2 * i; });
  EXPECT_NE(problem().find("at rest"), std::string::npos) << problem();
}

}  // namespace
}  // namespace dominant_plane_detection
