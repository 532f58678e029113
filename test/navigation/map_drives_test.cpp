// Maps of rendered rooms that a robot drives through, against their floor plans.

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "navigation/map_drive.h"
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
    for (std::uint32_t seed = 1; seed <= rooms; ++seed) {
      const MapFigures f =
          driveThroughRoom(seed, error, longForm(12, 24), longForm(5, 10), pictureOf(name, seed));
      std::cout << name << " " << seed << ": IoU of free cells " << f.sum_iou / f.maps
                << " (mean), " << f.least_iou << " (least) of " << f.maps << " maps, left free "
                << f.left_free << " of " << f.obstacle_cells << ", things missed " << f.missed
                << " of " << f.things << ", " << f.sum_milliseconds / f.images << " ms\n";
      EXPECT_GE(f.least_iou, 0.95);
      EXPECT_EQ(f.left_free, 0);
      EXPECT_EQ(f.missed, 0);
    }
  }
}

}  // namespace
}  // namespace dominant_plane_detection
