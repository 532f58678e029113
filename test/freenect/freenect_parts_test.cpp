// The parts of the Kinect's plug-in that need no libfreenect.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/disparity_table.h"
#include "freenect_driver/depth_tables.h"
#include "freenect_driver/tick_clock.h"

namespace dominant_plane_detection::freenect_driver {
namespace {

TEST(TickClockTest, GoesOnWhereTheTicksBeginAgain) {
  TickClock clock;
  EXPECT_EQ(clock.at(4294967000U), 0U);
  EXPECT_EQ(clock.at(4294967000U + 600U), 10U);  // past 2^32
  EXPECT_EQ(clock.at(304U + 60'000'000U), 1'000'010U);
}

TEST(TickClockTest, FollowsStampsThatGoBackALittleOrBeginAgain) {
  TickClock clock;
  EXPECT_EQ(clock.at(6'000'000U), 0U);
  EXPECT_EQ(clock.at(12'000'000U), 100'000U);
  EXPECT_EQ(clock.at(11'940'000U), 99'000U) << "the other camera's image";
  EXPECT_EQ(clock.at(6'000'000U), 0U) << "a recording from its beginning";
  EXPECT_EQ(clock.at(3'000'000U), 0U) << "never negative";
}

constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;

TEST(DepthTablesTest, WithoutADeviceTheUsualCalibration) {
  const DepthTables tables;
  EXPECT_FALSE(tables.registers());
  const DisparityTable usual(DepthCalibration::kinect());
  std::vector<std::uint16_t> readings(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) readings[i] = static_cast<std::uint16_t>(i % 2100);
  const std::vector<std::uint16_t> raw = readings;
  tables.toMillimetres(readings.data());
  for (std::size_t i = 0; i < kPixels; ++i) ASSERT_EQ(readings[i], usual[raw[i]]) << raw[i];
}

/// A device whose colour camera sees everything 3 px to the right and 2 px higher, and what is at
/// 900 mm another 5 px.
class DeviceTables : public testing::Test {
 protected:
  DeviceTables() : millimetres_(2048), shift_(10000), table_(kPixels * 2) {
    for (std::size_t raw = 0; raw < 2047; ++raw) {
      millimetres_[raw] = static_cast<std::uint16_t>(raw + 100);
    }
    shift_[900] = 5 * 256;
    for (std::size_t i = 0; i < kPixels; ++i) {
      table_[2 * i] = 256 * (static_cast<std::int32_t>(i % kWidth) + 3);
      table_[2 * i + 1] = static_cast<std::int32_t>(i / kWidth) - 2;
    }
    device_.raw_to_mm_shift = millimetres_.data();
    device_.depth_to_rgb_shift = shift_.data();
    device_.registration_table = reinterpret_cast<std::int32_t(*)[2]>(table_.data());
  }
  static std::uint16_t& at(std::vector<std::uint16_t>& image, std::size_t u, std::size_t v) {
    return image[v * kWidth + u];
  }

  std::vector<std::uint16_t> millimetres_;
  std::vector<std::int32_t> shift_, table_;
  freenect_registration device_{};
};

TEST_F(DeviceTables, RegistersToTheColourCameraAndKeepsTheNearest) {
  DepthTables tables(device_);
  ASSERT_TRUE(tables.registers());
  std::vector<std::uint16_t> readings(kPixels, 2047);
  at(readings, 100, 100) = 500;   // 600 mm, to (103, 98)
  at(readings, 200, 200) = 800;   // 900 mm, to (208, 198)
  at(readings, 205, 200) = 1000;  // 1100 mm, to (208, 198) as well, behind the other
  at(readings, 638, 50) = 500;    // leaves the image
  at(readings, 10, 1) = 500;      // too
  tables.toRegistered(readings.data());
  EXPECT_EQ(at(readings, 103, 98), 600);
  EXPECT_EQ(at(readings, 208, 198), 900);
  EXPECT_EQ(std::count(readings.begin(), readings.end(), 0),
            static_cast<std::ptrdiff_t>(kPixels) - 2);
}

TEST_F(DeviceTables, RowsAboveTheDepthImageAreLeftOut) {
  device_.reg_pad_info.start_lines = 10;
  DepthTables tables(device_);
  std::vector<std::uint16_t> readings(kPixels, 2047);
  at(readings, 100, 100) = 500;
  tables.toRegistered(readings.data());
  EXPECT_EQ(at(readings, 103, 88), 600);
}

}  // namespace
}  // namespace dominant_plane_detection::freenect_driver
