// Maps of rendered rooms that a robot drives through, against their floor plans.

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "navigation/map_drive.h"
#include "navigation/person_walk.h"
#include "support/long_form.h"

namespace dominant_plane_detection {
namespace {

/// @return the file for the picture of a room, where DPD_PICTURES names a folder.
std::string pictureOf(const char* sensor, std::uint32_t seed) {
  const char* folder = std::getenv("DPD_PICTURES");
  return folder == nullptr ? ""
                           : std::string(folder) + "/" + sensor + std::to_string(seed) + ".png";
}

TEST(MapDrives, WhatIsFreeIsFreeAndWhatStandsThereIsOccupied) {
  const auto rooms = static_cast<std::uint32_t>(longForm(2, 10));
  for (const auto& [name, error] : {std::make_pair("kinect", ErrorKind::kKinect),
                                    std::make_pair("realsense", ErrorKind::kRealsense)}) {
    int things = 0, missed = 0;
    for (std::uint32_t seed = 1; seed <= rooms; ++seed) {
      const MapFigures f =
          driveThroughRoom(seed, error, longForm(12, 24), longForm(5, 10), pictureOf(name, seed));
      std::cout << name << " " << seed << ": IoU of free cells " << f.sum_iou / f.maps
                << " (mean), " << f.least_iou << " (least) of " << f.maps << " maps, left free "
                << f.left_free << " of " << f.obstacle_cells << ", things missed " << f.missed
                << " of " << f.things << ", " << f.sum_milliseconds / f.images << " ms\n";
      ASSERT_GT(f.maps, 0);
      ASSERT_GT(f.things, 0);
      ASSERT_GT(f.obstacle_cells, 100);
      EXPECT_GE(f.sum_iou, 0.95 * f.maps);
      EXPECT_GE(f.least_iou, 0.9);
      // An edge of a table that a Kinect's error moves by more than a cell.
      EXPECT_LE(f.left_free, 0.003 * f.obstacle_cells);
      things += f.things, missed += f.missed;
    }
    EXPECT_LE(missed, 0.01 * things) << name;
  }
}

/// While the robot stands and while it drives, at 30 and at 10 images a second.
TEST(MapDrives, APersonWhoWalkedPastLeavesNoTrace) {
  const auto walks = static_cast<std::uint32_t>(longForm(2, 20));
  for (const auto& [name, error] : {std::make_pair("kinect", ErrorKind::kKinect),
                                    std::make_pair("realsense", ErrorKind::kRealsense)}) {
    PersonFigures all;
    for (std::uint32_t seed = 1; seed <= walks; ++seed) {
      const double speed = seed % 2 == 0 ? 0.1 : 0.0;
      const double rate = longForm(0, 1) == 1 && seed % 4 < 2 ? 30.0 : 10.0;
      const PersonFigures f = letPersonWalkPast(error, seed, speed, rate);
      EXPECT_GT(f.occupied, 60) << seed;
      all.occupied += f.occupied, all.trace += f.trace, all.left += f.left;
    }
    std::cout << name << ": " << all.left << " of " << all.trace
              << " cells not free within 3 s after the person, of " << all.occupied << " in "
              << walks << " walks\n";
    EXPECT_GT(2 * all.trace, all.occupied) << name;
    EXPECT_EQ(all.left, 0) << name;
  }
}

}  // namespace
}  // namespace dominant_plane_detection
