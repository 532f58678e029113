// The detector against scenes whose truth is exact.

#include <gtest/gtest.h>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/mahalanobis.h"
#include "support/scoring.h"
#include "synthetic_set.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;

class RandomScenes : public testing::Test {
 protected:
  static void SetUpTestSuite() { set_ = new ReferenceSet(loadRandomScenes(60)); }
  static void TearDownTestSuite() { delete set_; }
  static ReferenceSet* set_;
};
ReferenceSet* RandomScenes::set_ = nullptr;

TEST_F(RandomScenes, GridFindsTheTruth) {
  DominantPlaneDetector detector;
  std::vector<Score> scores;
  for (const ReferenceImage& image : set_->images) {
    scores.push_back(score(detector.detect(set_->view(image), set_->camera), *set_, image));
    EXPECT_FALSE(scores.back().failed()) << "scene " << image.name;
  }
  const Summary summary = summarize(scores);
  RecordProperty("iou_median", std::to_string(summary.iou_median));
  EXPECT_GE(summary.iou_median, 0.985);
  EXPECT_GE(summary.iou_p10, 0.95);
  EXPECT_LE(summary.angle_median, 0.05 * kDegree);
  EXPECT_LE(summary.height_median, 0.0006);
}

/// The same scenes with readings that err together, as a sensor's do: no averaging gets below that.
TEST(SmoothRandomScenes, GridFindsTheTruthAsWellAsTheReadingsAllow) {
  const ReferenceSet set = loadSmoothRandomScenes(60);
  DominantPlaneDetector detector;
  std::vector<Score> scores;
  std::vector<double> squares;
  for (const ReferenceImage& image : set.images) {
    const Detection& detection = detector.detect(set.view(image), set.camera);
    scores.push_back(score(detection, set, image));
    EXPECT_TRUE(scores.back().found) << "scene " << image.name;
    if (scores.back().failed()) continue;
    squares.push_back(squaredMahalanobis(
        detection.covariance,
        planeDifference(detection.normal, detection.distance, image.up, image.height)));
  }
  const Summary summary = summarize(scores);
  // In some of the images the error of half the floor is several times sigma(z).
  EXPECT_LE(summary.failures, 2U);
  // Of the order of what the halves of an Xtion's images differ by, 0.84 degrees and 9.8 mm.
  EXPECT_LE(summary.angle_median, 1.0 * kDegree);
  EXPECT_LE(summary.height_median, 0.012);
  EXPECT_GE(summary.iou_median, 0.95);
  // And it knows how far off it may be: 3 and 7.8 were these errors those of the covariance.
  EXPECT_NEAR(quantile(squares, 0.5), 2.37, 1.2);
  EXPECT_GE(quantile(squares, 0.95), 5.0);
  EXPECT_LE(quantile(squares, 0.90), 9.5);
}

TEST_F(RandomScenes, KdtreeAgreesWithGrid) {
  Parameters published;
  published.algorithm = Algorithm::kKdtree;
  DominantPlaneDetector grid, kdtree(published);
  std::vector<double> overlaps;
  // Every third scene: the point by point growth takes its time.
  for (std::size_t i = 0; i < set_->images.size(); i += 3) {
    const DepthView depth = set_->view(set_->images[i]);
    overlaps.push_back(groundOverlap(grid.detect(depth, set_->camera).labels,
                                     kdtree.detect(depth, set_->camera).labels));
  }
  EXPECT_GE(quantile(overlaps, 0.5), 0.97);
}

}  // namespace
}  // namespace dominant_plane_detection
