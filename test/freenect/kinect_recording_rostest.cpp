// The raw frames of a real Kinect v1, the whole way from libfreenect to the plane.

#include <cv_bridge/cv_bridge.h>

#include <opencv2/imgcodecs.hpp>

#include "dominant_plane_detection/depth_calibration.h"
#include "freenect/kinect_chain.h"
#include "support/fakenect_session.h"
#include "support/recordings.h"

namespace dominant_plane_detection {
namespace {

constexpr std::size_t kFrames = 29;
constexpr double kDegree = 0.0174533;  // [rad]

std::vector<cv::Mat> loadRawImages() {
  std::vector<cv::Mat> images;
  for (std::size_t i = 1; i <= kFrames; ++i) {
    char name[32];
    std::snprintf(name, sizeof(name), "/raw_disparity/%04zu.png", i);
    const cv::Mat image = cv::imread(recordingsFolder() + name, cv::IMREAD_UNCHANGED);
    if (image.type() == CV_16UC1) images.push_back(image);
  }
  return images;
}

/// The plane that fills most of all the frames: a desk's top.
const Eigen::Vector3d kNormal = Eigen::Vector3d(-0.02, -0.88, -0.48).normalized();

/// The smallest and largest of a number.
struct Extent {
  double least = 1e9, most = -1e9;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

/// How far the depth of a calibration is from that of the reciprocal form.
struct Deviation {
  double worst = 0.0;           ///< [m]
  double worst_relative = 0.0;  ///< [-] the rounding to millimetres apart
  Extent depth;                 ///< [m] of the readings
  std::size_t readings = 0;
};

Deviation compare(const cv::Mat& raw, const sensor_msgs::Image& depth, double near, double far) {
  const DepthCalibration reference = DepthCalibration::kinect();
  constexpr double kRounding = 0.0005;  // [m]
  Deviation deviation;
  for (int v = 0; v < raw.rows; ++v) {
    const auto* row = reinterpret_cast<const std::uint16_t*>(
        &depth.data[static_cast<std::size_t>(v) * depth.step]);
    for (int u = 0; u < raw.cols; ++u) {
      const double z = reference.distance(raw.at<std::uint16_t>(v, u));
      if (z < near || z > far) continue;
      const double error = std::abs(0.001 * row[u] - z);
      deviation.worst = std::max(deviation.worst, error);
      deviation.worst_relative =
          std::max(deviation.worst_relative, std::max(error - kRounding, 0.0) / z);
      if (z <= 0.0) continue;
      deviation.depth.add(z);
      ++deviation.readings;
    }
  }
  return deviation;
}

void merge(const Deviation& one, Deviation& all) {
  all.worst = std::max(all.worst, one.worst);
  all.worst_relative = std::max(all.worst_relative, one.worst_relative);
  all.depth.add(one.depth.least);
  all.depth.add(one.depth.most);
  all.readings += one.readings;
}

void print(const Deviation& all, const Extent& distance, const Extent& angle) {
  std::cout << all.readings << " readings from " << all.depth.least << " to " << all.depth.most
            << " m, at most " << 1000.0 * all.worst << " mm and " << 100.0 * all.worst_relative
            << " % from the reciprocal form; planes " << distance.least << " to " << distance.most
            << " m away, normals up to " << angle.most / kDegree << " deg from the reference\n";
}

class KinectRecording : public testing::Test {
 protected:
  /// libfreenect's player can be started once in a process: one session serves all tests.
  static void SetUpTestSuite() {
    images_ = new std::vector<cv::Mat>(loadRawImages());
    if (images_->size() != kFrames) return;
    session_ = new FakenectSession("kinect_recording");
    for (std::size_t i = 0; i < kFrames; ++i) {
      session_->addDepth(1000.0 + static_cast<double>(i) / 30.0, (*images_)[i]);
    }
    session_->repeat(static_cast<double>(kFrames) / 30.0, 200);
    setenv("FAKENECT_PATH", session_->folder().c_str(), 1);
    CameraModel camera;
    camera.width = 640;
    camera.height = 480;
    camera.fx = camera.fy = 521.0;
    camera.cx = 325.1;
    camera.cy = 249.7;
    camera_info_url_ = writeCameraInfo(session_->folder(), camera);
  }
  static void TearDownTestSuite() { delete session_; }

  void SetUp() override {
    if (session_ == nullptr) GTEST_SKIP() << "no raw_disparity in " << recordingsFolder();
  }

  /// Runs the recording through, and checks every plane.
  std::vector<ChainResult> resultsOf(const std::string& calibration, bool overlays) {
    KinectChain chain(*images_);
    EXPECT_TRUE(chain.run(calibration, camera_info_url_, overlays));
    return chain.results();
  }

  static std::vector<cv::Mat>* images_;
  static FakenectSession* session_;
  static std::string camera_info_url_;
};
std::vector<cv::Mat>* KinectRecording::images_ = nullptr;
FakenectSession* KinectRecording::session_ = nullptr;
std::string KinectRecording::camera_info_url_;

TEST_F(KinectRecording, ReciprocalFormFindsTheDeskInEveryFrame) {
  const auto results = resultsOf("kinect_reciprocal.yaml", true);
  Deviation all;
  Extent distance, angle;
  for (std::size_t i = 0; i < results.size(); ++i) {
    ASSERT_TRUE(results[i].plane && results[i].overlay) << "frame " << i + 1;
    const DominantPlane& plane = *results[i].plane;
    EXPECT_EQ(plane.state, DominantPlane::FOUND) << "frame " << i + 1 << ": " << plane.reason;
    merge(compare((*images_)[i], *results[i].depth, 0.0, 65.0), all);
    distance.add(plane.distance);
    angle.add(angleBetween(normalOf(plane), kNormal));
  }
  print(all, distance, angle);
  EXPECT_LE(all.worst, 0.001);
  EXPECT_GT(all.readings, 1000000U);
  EXPECT_GE(distance.least, 0.85);
  EXPECT_LE(distance.most, 0.91);
  EXPECT_LE(angle.most, 3.0 * kDegree);
  const char* const folder = std::getenv("DPD_PICTURES");  // for people to look at
  if (folder == nullptr) return;
  const auto picture = cv_bridge::toCvShare(results.front().overlay, "bgr8");
  cv::imwrite(std::string(folder) + "/kinect_overlay.png", picture->image);
}

TEST_F(KinectRecording, ExponentialFormIsAsGoodAsItCanBe) {
  const auto results = resultsOf("kinect_exponential.yaml", false);
  Deviation all;
  Extent distance, angle;
  for (std::size_t i = 0; i < results.size(); ++i) {
    ASSERT_TRUE(results[i].plane) << "frame " << i + 1;
    const DominantPlane& plane = *results[i].plane;
    EXPECT_EQ(plane.state, DominantPlane::FOUND) << "frame " << i + 1 << ": " << plane.reason;
    merge(compare((*images_)[i], *results[i].depth, 0.5, 4.0), all);
    distance.add(plane.distance);
    angle.add(angleBetween(normalOf(plane), kNormal));
  }
  print(all, distance, angle);
  EXPECT_LE(all.worst, 0.060);
  EXPECT_LE(all.worst_relative, 0.020);
  // Points that are off by up to 60 mm, here too near and there too far, shift and tilt the plane.
  EXPECT_GE(distance.least, 0.85 - 0.06);
  EXPECT_LE(distance.most, 0.91 + 0.06);
  EXPECT_LE(angle.most, 6.0 * kDegree);
}

}  // namespace
}  // namespace dominant_plane_detection
