// The detector against real recordings with a known plane and mask.

#include <gtest/gtest.h>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/scoring.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// What a reference set demands of the medians and tenth percentiles.
struct Demand {
  const char* name;
  ReferenceSet (*load)();
  std::size_t images;
  std::size_t failures;  ///< [#] at most
  double iou_median;
  double iou_p10;
  double angle;   ///< [rad] median
  double height;  ///< [m] median
};

class RealImages : public testing::TestWithParam<Demand> {
 protected:
  void SetUp() override {
    set_ = GetParam().load();
    if (set_.images.empty()) {
      GTEST_SKIP() << "no recordings in " << recordingsFolder() << "; set DPD_RECORDINGS";
    }
    ASSERT_EQ(set_.images.size(), GetParam().images);
    parameters_.range_min = set_.range_min;
    parameters_.range_max = set_.range_max;
  }

  ReferenceSet set_;
  Parameters parameters_;
};

TEST_P(RealImages, GridMeetsTheReference) {
  DominantPlaneDetector detector(parameters_);
  std::vector<Score> scores;
  for (const ReferenceImage& image : set_.images) {
    scores.push_back(score(detector.detect(set_.view(image), set_.camera), set_, image));
  }
  const Summary summary = summarize(scores);
  EXPECT_LE(summary.failures, GetParam().failures);
  EXPECT_GE(summary.iou_median, GetParam().iou_median);
  EXPECT_GE(summary.iou_p10, GetParam().iou_p10);
  EXPECT_LE(summary.angle_median, GetParam().angle);
  EXPECT_LE(summary.height_median, GetParam().height);
}

TEST_P(RealImages, KdtreeAgreesWithGrid) {
  Parameters published = parameters_;
  published.algorithm = Algorithm::kKdtree;
  DominantPlaneDetector grid(parameters_), kdtree(published);
  std::vector<double> overlaps;
  // Every third image: the point by point growth takes its time.
  for (std::size_t i = 0; i < set_.images.size(); i += 3) {
    const DepthView depth = set_.view(set_.images[i]);
    overlaps.push_back(groundOverlap(grid.detect(depth, set_.camera).labels,
                                     kdtree.detect(depth, set_.camera).labels));
  }
  EXPECT_GE(quantile(overlaps, 0.5), 0.95);
}

INSTANTIATE_TEST_SUITE_P(
    Recordings, RealImages,
    testing::Values(Demand{"robot_lab", loadRobotLab, 24, 0, 0.99, 0.979, 0.3 * kDegree, 0.004},
                    Demand{"cabinet", loadCabinet, 20, 0, 0.999, 0.996, 0.2 * kDegree, 0.004},
                    Demand{"low_robot", loadLowRobot, 10, 1, 0.994, 0.97, 0.3 * kDegree, 0.004}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace dominant_plane_detection
