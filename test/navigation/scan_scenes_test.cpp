// Scans of rendered rooms with the errors of sensors, against what really stands there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "navigation/ground_frame.h"
#include "navigation/ground_scan.h"
#include "navigation/scan_figures.h"
#include "support/long_form.h"
#include "support/recordings.h"

namespace dominant_plane_detection {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Scans of recorded images, and which readings are of their masks' ground.
class RecordedScans {
 public:
  int readings = 0;
  int ghosts = 0;  ///< [#] runs of readings

  void add(const ReferenceSet& set, const ReferenceImage& image) {
    Parameters parameters;
    parameters.range_min = set.range_min;
    parameters.range_max = set.range_max;
    DominantPlaneDetector detector(parameters);
    const DepthView depth = set.view(image);
    const Detection& detection = detector.detect(depth, set.camera);
    RayTable rays;
    rays.build(set.camera);
    ScanLimits limits;
    limits.range_max = set.range_max;
    const GroundScan scan = GroundScanner().scan(depth, rays, detection, limits);
    const Eigen::Isometry3d frame = groundFromOptical(detection.normal, detection.distance);
    // [px] within 10 cm of each reading: all, and ground by the mask.
    std::vector<int> all(scan.ranges.size()), ground(scan.ranges.size());
    for (int v = 0; v < depth.height; ++v) {
      for (int u = 0; u < depth.width; ++u) {
        const Label label = detection.label(u, v);
        if (label != Label::kObstacle && label != Label::kDropOff) continue;
        const Eigen::Vector3d ray = rays.ray(u, v).cast<double>();
        const double z = label == Label::kObstacle
                             ? static_cast<double>(metresAt(depth, u, v))
                             : -detection.distance / detection.normal.dot(ray);
        const Eigen::Vector3d at = frame * (z * ray);
        const auto i = static_cast<std::size_t>(
            std::lround((std::atan2(at.y(), at.x()) - scan.angle_min) / scan.angle_increment));
        const bool in_cell = i < all.size() && std::abs(at.head<2>().norm() -
                                                        static_cast<double>(scan.ranges[i])) < 0.1;
        if (!in_cell) continue;
        ++all[i];
        ground[i] += image.ground.at<std::uint8_t>(v, u) != 0;
      }
    }
    bool before = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      readings += std::isfinite(scan.ranges[i]);
      const bool ghost = all[i] > 0 && 2 * ground[i] > all[i];
      ghosts += ghost && !before;
      before = ghost;
    }
  }
};

void print(const char* name, const ScanFigures& f) {
  std::cout << name << ": floor in " << f.found << " of " << f.images << " images, 5 cm "
            << f.low_seen << " of " << f.low << ", 10 cm " << f.high_seen << " of " << f.high
            << ", ghosts " << f.ghosts << ", off " << 1e3 * median(f.off) << " mm, "
            << 100.0 * median(f.relative) << " % (medians)\n";
}

TEST(ScanScenes, WhatStandsThereIsInTheScanAndNothingElse) {
  const int images = longForm(30, 400);
  const ScanFigures smooth = scanFigures(ErrorKind::kSmooth, ScanRule::kGround, 1, images);
  print("smooth errors", smooth);
  EXPECT_GE(smooth.found, images - images / 100);
  EXPECT_GE(smooth.low, images / 2);
  EXPECT_GE(smooth.low_seen, 0.98 * smooth.low);
  EXPECT_GE(smooth.high, images);
  EXPECT_EQ(smooth.high_seen, smooth.high);
  EXPECT_LE(smooth.ghosts, images / 10);
  EXPECT_LT(median(smooth.off), 0.02);
  EXPECT_LT(median(smooth.relative), 0.02);
}

/// Rooms whose floor was once told in two by its errors, of which one half was called drop-off or
/// obstacle.
TEST(ScanScenes, AFloorThatErrorsBendStaysOneSurface) {
  for (const std::uint32_t seed : {109, 127, 208, 256, 317, 339}) {
    EXPECT_EQ(scanFigures(ErrorKind::kSmooth, ScanRule::kGround, seed, 1).ghosts, 0) << seed;
  }
}

/// Larger errors than those of real cameras on real floors, see below: readings that are right stay
/// so.
TEST(ScanScenes, WithTheErrorsOfSensorsReadingsAreWhereThingsAre) {
  const int images = longForm(15, 400);
  for (const auto& [name, error] : {std::make_pair("RealSense", ErrorKind::kRealsense),
                                    std::make_pair("Kinect", ErrorKind::kKinect)}) {
    const ScanFigures figures = scanFigures(error, ScanRule::kGround, 1, images);
    print(name, figures);
    EXPECT_GE(figures.low_seen, 0.9 * figures.low) << name;
    EXPECT_GE(figures.high_seen, 0.9 * figures.high) << name;
    EXPECT_LE(figures.ghosts, 4 * images) << name;
    EXPECT_LT(median(figures.off), 0.025) << name;
    EXPECT_LT(median(figures.relative), 0.02) << name;
  }
}

/// What is written for a camera that stands upright is not right for one that does not.
TEST(ScanScenes, FixedColumnsMissWhatIsLowAndSeeTheFloor) {
  const int images = longForm(15, 400);
  const ScanFigures columns = scanFigures(ErrorKind::kSmooth, ScanRule::kFixedColumns, 1, images);
  print("fixed columns", columns);
  EXPECT_LT(columns.low_seen, 0.7 * columns.low);
  EXPECT_GT(columns.ghosts, images);
}

/// Readings most of whose pixels, and of those behind them, are ground in the mask of a recording;
/// what stands there has its foot in the mask, a band of three sigma.
TEST(ScanScenes, FloorsOfRecordingsAreFree) {
  for (const ReferenceSet& set : {loadRobotLab(), loadCabinet()}) {
    if (set.images.empty()) GTEST_SKIP() << "there is no " << set.name;
    RecordedScans scans;
    for (const ReferenceImage& image : set.images) scans.add(set, image);
    std::cout << set.name << ": " << scans.ghosts << " ghosts and " << scans.readings
              << " readings in " << set.images.size() << " images\n";
    EXPECT_LE(3 * scans.ghosts, static_cast<int>(set.images.size()));
    EXPECT_GT(scans.readings, 10 * static_cast<int>(set.images.size()));
  }
}

}  // namespace
}  // namespace dominant_plane_detection
