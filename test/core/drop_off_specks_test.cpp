#include "core/drop_off_specks.h"

#include <gtest/gtest.h>

#include <utility>

#include "core/label_rule.h"
#include "dominant_plane_detection/detection.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

constexpr auto kGround = static_cast<std::uint8_t>(Label::kGround);
constexpr auto kDropOff = static_cast<std::uint8_t>(Label::kDropOff);
constexpr auto kUnknown = static_cast<std::uint8_t>(Label::kUnknown);
constexpr double kMinWidth = 0.08;  // [m]

/// An image of ground at one depth: at 2 m a pixel is 3.8 mm wide.
class DropOffSpecksTest : public testing::Test {
 protected:
  explicit DropOffSpecksTest(float z = 2.0F) : depth_(640, 480), labels_(640 * 480, kGround) {
    std::fill(depth_.pixels.begin(), depth_.pixels.end(), z);
  }

  void put(int left, int top, int width, int height) {
    for (int v = top; v < top + height; ++v) {
      for (int u = left; u < left + width; ++u) at(u, v) = kDropOff;
    }
  }
  std::uint8_t& at(int u, int v) { return labels_[static_cast<std::size_t>(v * 640 + u)]; }
  void remove() {
    RayTable rays;
    rays.build(testCamera());
    specks_.remove({depth_.view(), rays, {1.0F, 0.5F, 4.0F}}, tiles_, kMinWidth, labels_);
  }

  OwnedDepth<float> depth_;
  std::vector<std::uint8_t> labels_;
  std::vector<std::uint8_t> tiles_ = std::vector<std::uint8_t>(80 * 60, kNearGround);
  DropOffSpecks specks_;
};

/// 21 pixels are 80 mm at 2 m.
TEST_F(DropOffSpecksTest, ANarrowOneIsUnknownAndAWideOneStays) {
  put(100, 100, 20, 20);
  put(200, 100, 22, 2);
  put(300, 100, 2, 22);
  remove();
  EXPECT_EQ(at(100, 100), kUnknown);
  EXPECT_EQ(at(119, 119), kUnknown);
  EXPECT_EQ(at(200, 100), kDropOff);
  EXPECT_EQ(at(221, 101), kDropOff);
  EXPECT_EQ(at(300, 121), kDropOff);
  EXPECT_EQ(at(50, 50), kGround);
}

/// What is found to be large from one end stays whole, however it is shaped.
TEST_F(DropOffSpecksTest, AllThatHangsTogetherStays) {
  for (int i = 0; i < 200; ++i) at(100 + i, 100 + i) = kDropOff;  // by corners
  for (int i = 0; i < 200; ++i) at(299 - i, 302 + i / 8) = kDropOff;
  at(299, 300) = at(299, 301) = kDropOff;
  put(400, 400, 5, 5);
  remove();
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(at(100 + i, 100 + i), kDropOff) << i;
    EXPECT_EQ(at(299 - i, 302 + i / 8), kDropOff) << i;
  }
  EXPECT_EQ(at(402, 402), kUnknown);
}

/// What is cut off may be larger.
TEST_F(DropOffSpecksTest, AtTheBorderOfTheImageAllStay) {
  put(0, 100, 3, 3);
  put(637, 100, 3, 3);
  put(300, 0, 3, 3);
  put(300, 477, 3, 3);
  remove();
  for (const auto& [u, v] : {std::pair{1, 101}, {638, 101}, {301, 1}, {301, 478}}) {
    EXPECT_EQ(at(u, v), kDropOff) << u << ", " << v;
  }
}

/// One far reading among near ones does not make it wide.
TEST_F(DropOffSpecksTest, TheNearestReadingSaysHowWideItIs) {
  put(100, 100, 20, 20);
  for (int i = 0; i < 20; ++i) depth_.at(119, 100 + i) = 9.0F;
  remove();
  EXPECT_EQ(at(100, 100), kUnknown);
  EXPECT_EQ(at(119, 119), kUnknown);
}

/// At 4 m 11 pixels are 80 mm wide: less than 16, over which errors hang together.
TEST_F(DropOffSpecksTest, FarAwayABumpOfTheErrorIsNone) {
  std::fill(depth_.pixels.begin(), depth_.pixels.end(), 4.0F);
  put(100, 100, 15, 15);
  put(200, 100, 16, 15);
  remove();
  EXPECT_EQ(at(100, 100), kUnknown);
  EXPECT_EQ(at(200, 100), kDropOff);
}

TEST_F(DropOffSpecksTest, AwayFromTheGroundNothingIsLookedAt) {
  std::fill(tiles_.begin(), tiles_.end(), kElsewhere);
  tiles_[20] = kBelow;
  put(100, 100, 3, 3);
  put(161, 1, 3, 3);
  remove();
  EXPECT_EQ(at(101, 101), kDropOff);
  EXPECT_EQ(at(162, 2), kDropOff);
}

/// A piece that only begins on the ground is measured as a whole; the same twice, as the next image
/// finds nothing of the one before.
TEST_F(DropOffSpecksTest, APieceIsMeasuredBeyondTheGroundsTiles) {
  for (std::size_t i = 0; i < tiles_.size(); ++i) tiles_[i] = i % 80 < 20 ? kSmeared : kElsewhere;
  for (int image = 0; image < 2; ++image) {
    put(150, 100, 40, 3);
    put(150, 200, 15, 3);
    remove();
    EXPECT_EQ(at(150, 100), kDropOff);
    EXPECT_EQ(at(150, 200), kUnknown);
    EXPECT_EQ(at(164, 200), kUnknown);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
