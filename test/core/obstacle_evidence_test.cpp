#include "core/obstacle_evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

constexpr int kRow = 60;  // of blocks, 2.33 m away, where small blocks look for what is 8 cm wide

/// A floor in blocks of 4 pixels, all read, whose heights and whose ground tiles a test chooses.
class ObstacleEvidenceTest : public testing::Test {
 protected:
  ObstacleEvidenceTest() {
    rays_.build(testCamera());
    blocks_.resize(640, 480);
    blocks_.count.assign(blocks_.size(), 16.0F);
    blocks_.sum.assign(blocks_.size(), 0.0F);
    blocks_.beyond.assign(blocks_.size(), 0);
    blocks_.off.assign(blocks_.size(), 0);
    limits_.min_height = 0.005;
    limits_.min_width = 0.08;
    limits_.false_alarm_rate = 0.2;
    limits_.local_error = {0.004, 0.0};
  }

  void raise(int left, int right, int top, int bottom, float height) {
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        blocks_.sum[static_cast<std::size_t>(y * blocks_.columns + x)] += 16.0F * height;
      }
    }
  }
  void takeGround(int first_column, int last_column) {
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      const int column = static_cast<int>(i % 80);
      if (column >= first_column && column <= last_column) kinds_[i] = kElsewhere;
    }
  }
  /// @return that of the smallest blocks.
  std::vector<Evidence> find() {
    const Eigen::Vector3f up = upOf(0.3).cast<float>();
    const LabelRule rule{{up.x(), up.y(), up.z()}, 0.7F, 0.01F, 0.007F, 0.0025F, 0.0018F};
    evidence_.look(rays_, rule, blocks_, limits_, kinds_);
    std::vector<Evidence> found;
    evidence_.find(evidence_.ground().levels().front(), found);
    return found;
  }

  RayTable rays_;
  BlockHeights blocks_;
  LowObstacleLimits limits_;
  std::vector<std::uint8_t> kinds_ = std::vector<std::uint8_t>(80 * 60, kNearGround);
  ObstacleEvidence evidence_;
};

TEST_F(ObstacleEvidenceTest, IsWhatIsHigh) {
  EXPECT_TRUE(find().empty());
  raise(70, 74, kRow, kRow + 1, 0.03F);
  const std::vector<Evidence> found = find();
  ASSERT_EQ(found.size(), 10U);
  for (const Evidence& block : found) {
    EXPECT_TRUE(block.x >= 70 && block.x <= 74 && block.y >= kRow && block.y <= kRow + 1);
    EXPECT_NEAR(block.height, 0.03F, 0.001F);
  }
}

/// Waves of 20 mm over 15 rows, which a window of 7 rows does not follow: blocks are up to 6 mm off
/// it, and a sill of 11 mm on top of a wave, 16 mm over the window's mean, is no more than 4.3
/// times what they err. Three rows are 12 mm, and 4.3 times the least that is believed of a
/// sensor 10.
TEST_F(ObstacleEvidenceTest, ASillIsToldFromTheFloorCloseToIt) {
  for (int y = 0; y < blocks_.rows; ++y) {
    raise(0, blocks_.columns - 1, y, y, 0.02F * std::cos(0.419F * static_cast<float>(y - kRow)));
  }
  limits_.local_error = {0.008, 0.0};
  EXPECT_TRUE(find().empty());
  raise(60, 90, kRow, kRow, 0.011F);
  const std::vector<Evidence> found = find();
  EXPECT_GE(found.size(), 29U);
  for (const Evidence& block : found) {
    EXPECT_EQ(block.y, kRow);
    EXPECT_TRUE(block.x >= 60 && block.x <= 90) << block.x;
  }
}

/// A row between two hollows is 36 mm higher than these, but 6 mm over the ground about it.
TEST_F(ObstacleEvidenceTest, ABumpInAHollowIsNone) {
  raise(60, 90, kRow - 2, kRow - 2, -0.03F);
  raise(60, 90, kRow + 1, kRow + 1, -0.03F);
  raise(60, 90, kRow, kRow, 0.006F);
  limits_.local_error = {0.006, 0.0};
  EXPECT_TRUE(find().empty());
}

/// 4 mm beside 30 mm: the mean of three is high, but not the block.
TEST_F(ObstacleEvidenceTest, ABlockBesideAHighOneIsNone) {
  limits_.min_height = 0.001;
  raise(70, 74, kRow, kRow + 1, 0.03F);
  raise(69, 69, kRow, kRow + 1, 0.004F);
  for (const Evidence& block : find()) EXPECT_GE(block.x, 70);
}

/// The means of two blocks, next to a column without readings, err more than those of three.
TEST_F(ObstacleEvidenceTest, OfTwoBlocksMoreIsAskedFor) {
  for (int y = 0; y < blocks_.rows; ++y) {
    blocks_.count[static_cast<std::size_t>(y * blocks_.columns + 75)] = 0.0F;
  }
  raise(73, 74, kRow, kRow + 1, 0.014F);
  const std::vector<Evidence> found = find();
  EXPECT_FALSE(found.empty());
  for (const Evidence& block : found) EXPECT_EQ(block.x, 73);
}

/// Three of seven columns of the window are ground, to both sides.
TEST_F(ObstacleEvidenceTest, LittleGroundOnTwoSidesIsEnough) {
  raise(79, 81, kRow, kRow, 0.02F);
  takeGround(39, 40);  // blocks 78 to 81
  EXPECT_FALSE(find().empty());
}

/// Three of seven rows of the window are ground, all before it: 17 mm are 4.3 local errors, and 26
/// are asked for of what is not as wide as a step.
TEST_F(ObstacleEvidenceTest, GroundOnOneSideIsEnoughForWhatIsWideOrHigh) {
  std::fill_n(kinds_.begin(), 80 * kRow / 2, kElsewhere);
  raise(71, 73, kRow - 4, kRow - 1, 0.02F);
  EXPECT_TRUE(find().empty());
  raise(71, 73, kRow - 4, kRow - 1, 0.01F);
  EXPECT_FALSE(find().empty());
  raise(71, 73, kRow - 4, kRow - 1, -0.03F);
  raise(60, 90, kRow - 4, kRow - 1, 0.02F);
  const std::vector<Evidence> wide = find();
  EXPECT_GE(wide.size(), 25U);
  for (const Evidence& block : wide) EXPECT_EQ(block.y, kRow - 1);
}

TEST_F(ObstacleEvidenceTest, IsNotNextToWhatIsTall) {
  raise(70, 74, kRow, kRow + 1, 0.03F);
  for (int y = kRow - 4; y < kRow; ++y) {
    for (int x = 66; x < 80; ++x)
      blocks_.off[static_cast<std::size_t>(y * blocks_.columns + x)] = 1;
  }
  EXPECT_TRUE(find().empty());
}

}  // namespace
}  // namespace dominant_plane_detection
