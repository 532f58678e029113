// A Kinect in a scene with known truth, recorded as libfreenect records one, the whole way from
// libfreenect to plane, colour image and gravity.

#include <sensor_msgs/Imu.h>

#include "freenect/kinect_chain.h"
#include "support/fakenect_session.h"
#include "synthetic/scene.h"
#include "virtual_kinect/scene_camera.h"

namespace dominant_plane_detection {
namespace {

constexpr int kFrames = 20;
constexpr double kSpacing = 0.4;  // [s] on the scene's path: frames differ
constexpr double kDegree = 0.0174533;

struct Truth {
  Eigen::Vector3d up;   ///< [-] in the optical frame
  double height = 0.0;  ///< [m]
};

/// One session for all tests: libfreenect's player can be started once in a process.
struct Session {
  Session() : scene(loadScene(DPD_SOURCE "/scenes/laboratory.yaml")), files("kinect_session") {
    scene.noise = SensorNoise::independent();  // averages out: what the chain does wrong shows
    const virtual_kinect::SceneCamera camera(scene);
    for (int i = 0; i < kFrames; ++i) {
      const double time = i / 30.0;
      const double scene_time = i * kSpacing;
      const Eigen::Isometry3d pose = scene.path.at(scene_time).pose();
      truths.push_back(
          {pose.linear().transpose() * Eigen::Vector3d::UnitZ(), pose.translation().z()});
      const Eigen::Vector3d felt = 9.80665 * truths.back().up;
      files.addAcceleration(1000.0 + time, {-felt.x(), -felt.y(), felt.z()});
      cv::Mat rgb(480, 640, CV_8UC3);
      camera.colour(scene_time, 640, 480, 1.0, rgb.data);
      colours.push_back(rgb);
      files.addColour(1000.0 + time + 0.001, rgb);
      cv::Mat raw(480, 640, CV_16UC1);
      camera.disparity(scene_time, 640, 480, static_cast<std::uint32_t>(i),
                       reinterpret_cast<std::uint16_t*>(raw.data));
      images.push_back(raw);
      files.addDepth(1000.0 + time + 0.002, raw);
    }
    files.repeat(kFrames / 30.0, 400);
    setenv("FAKENECT_PATH", files.folder().c_str(), 1);
    camera_info_url = writeCameraInfo(files.folder(), scene.camera);
  }

  Scene scene;
  FakenectSession files;
  std::vector<cv::Mat> images, colours;
  std::vector<Truth> truths;
  std::string camera_info_url;
};

class KinectSession : public testing::Test {
 protected:
  static void SetUpTestSuite() { session_ = new Session; }
  static void TearDownTestSuite() { delete session_; }

  struct Worst {
    double height = 0.0;  ///< [m]
    double angle = 0.0;   ///< [rad]
  };
  Worst worstOf(const std::string& calibration) {
    KinectChain chain(session_->images);
    EXPECT_TRUE(chain.run(calibration, session_->camera_info_url, false));
    Worst worst;
    for (std::size_t i = 0; i < session_->truths.size(); ++i) {
      const auto& plane = chain.results()[i].plane;
      if (!plane) continue;  // reported above
      EXPECT_EQ(plane->state, DominantPlane::FOUND) << plane->reason;
      const Truth& truth = session_->truths[i];
      worst.height = std::max(worst.height, std::abs(plane->distance - truth.height));
      worst.angle = std::max(worst.angle, angleBetween(normalOf(*plane), truth.up));
    }
    std::cout << calibration << ": worst height " << 1000.0 * worst.height << " mm, worst angle "
              << worst.angle / kDegree << " deg\n";
    return worst;
  }

  static Session* session_;
};
Session* KinectSession::session_ = nullptr;

TEST_F(KinectSession, ReciprocalFormGivesTheTrueFloor) {
  const Worst worst = worstOf("kinect_reciprocal.yaml");
  EXPECT_LE(worst.height, 0.005);
  EXPECT_LE(worst.angle, 0.3 * kDegree);
}

TEST_F(KinectSession, ExponentialFormGivesItWithinItsOwnError) {
  const Worst worst = worstOf("kinect_exponential.yaml");
  EXPECT_LE(worst.height, 0.06);
  EXPECT_LE(worst.angle, 3.0 * kDegree);
}

TEST_F(KinectSession, GravityAndColour) {
  ros::NodeHandle node("/camera");
  Manager manager;
  ASSERT_TRUE(manager.loadDriver("/camera", "freenect"));
  Listener<sensor_msgs::Image> depth(node, "depth/image_raw");
  Listener<sensor_msgs::Image> colour(node, "rgb/image_raw");
  Listener<sensor_msgs::Imu> imu(node, "imu/data_raw");
  ASSERT_TRUE(spinUntil([&] { return imu.size() >= 60 && colour.size() >= 30; }));
  double worst = 0.0;
  std::set<std::size_t> seen;
  for (const auto& reading : imu.messages()) {
    const auto& a = reading->linear_acceleration;
    const Eigen::Vector3d felt(a.x, a.y, a.z);
    if (felt.norm() < 1e-9) continue;  // before the recording's first reading
    double nearest = 1e9;
    std::size_t index = 0;
    for (std::size_t i = 0; i < session_->truths.size(); ++i) {
      const double angle = angleBetween(felt, session_->truths[i].up);
      if (angle < nearest) index = i;
      nearest = std::min(nearest, angle);
    }
    seen.insert(index);
    worst = std::max(worst, nearest);
    EXPECT_NEAR(felt.norm(), 9.80665, 0.05);
  }
  std::cout << imu.size() << " readings, " << seen.size() << " directions, worst "
            << worst / kDegree << " deg from the truth\n";
  EXPECT_LE(worst, 1.0 * kDegree);
  EXPECT_GE(seen.size(), 10U);
  for (const auto& image : colour.messages()) {
    ASSERT_EQ(image->encoding, "rgb8");
    bool known = false;
    for (const cv::Mat& rgb : session_->colours) {
      known = known || std::memcmp(image->data.data(), rgb.data, image->data.size()) == 0;
    }
    ASSERT_TRUE(known) << "an image that is not in the session";
  }
  manager.unload("/camera/driver");
}

}  // namespace
}  // namespace dominant_plane_detection
