// What a known plane, up or height changes on recordings.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "prior/angle.h"
#include "support/desk_truth.h"
#include "support/recordings.h"
#include "tools/inputs.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = M_PI / 180.0;

/// The images of a bag; none where the recordings are missing.
std::vector<Frame> bagFrames(const std::string& name) {
  std::vector<Frame> frames;
  const std::string file = recordingsFolder() + "/" + name;
  if (!std::ifstream(file).good()) return frames;
  const Inputs inputs = openInputs({file}, {});
  forEachFrame(inputs, "test", [&](const Frame& frame) {
    frames.push_back(frame);
    const DepthView& view = frame.depth;
    frames.back().pixels =
        cv::Mat(view.height, view.width, CV_16U, const_cast<void*>(view.data), view.step).clone();
    frames.back().depth.data = frames.back().pixels.data;
    frames.back().depth.step = frames.back().pixels.step;
  });
  return frames;
}

/// Holds what is found with the last image's plane known against what is found without.
class Follower {
 public:
  /// @return whether both find the same, within the noise.
  testing::AssertionResult look(const DepthView& depth, const CameraModel& camera) {
    const Detection& searched = searching_.detect(depth, camera);
    const Detection& followed = tracking_.detect(depth, camera, prior_);
    tracked += followed.tracked;
    saved += static_cast<int>(searched.effort.tests) - static_cast<int>(followed.effort.tests);
    prior_.predicted_plane.reset();
    if (followed.found()) {
      prior_.predicted_plane = {followed.normal, followed.distance, followed.covariance, 0.0};
    }
    const double angle = searched.found() ? angleBetween(searched.normal, followed.normal) : 0.0;
    const double height = searched.found() ? std::abs(searched.distance - followed.distance) : 0.0;
    if (searched.state == followed.state && angle < 0.05 * kDegree && height < 0.001) {
      return testing::AssertionSuccess();
    }
    return testing::AssertionFailure()
           << stateName(searched.state) << " and " << stateName(followed.state) << ", "
           << angle / kDegree << " deg and " << 1e3 * height << " mm apart";
  }

  int tracked = 0;  ///< [#] images
  int saved = 0;    ///< [#] tests of tiles

 private:
  DominantPlaneDetector searching_, tracking_;
  Prior prior_;
};

TEST(Tracking, EqualsTheSearchOnARobotsDrive) {
  const std::vector<Frame> frames = bagFrames("robot_lab.bag");
  if (frames.empty()) GTEST_SKIP() << "there is no robot_lab.bag in " << recordingsFolder();
  Follower follower;
  for (const Frame& frame : frames) {
    EXPECT_TRUE(follower.look(frame.depth, frame.camera)) << frame.name;
  }
  EXPECT_GE(follower.tracked, 110);
  EXPECT_GT(follower.saved, 0);
  std::cout << "tracked in " << follower.tracked << " of " << frames.size() << " images\n";
}

/// The image turned about the optical axis by half a turn, with its camera.
Frame turned(const Frame& frame) {
  Frame result = frame;
  cv::flip(frame.pixels, result.pixels, -1);
  result.depth.data = result.pixels.data;
  result.camera.cx = frame.camera.width - 1 - frame.camera.cx;
  result.camera.cy = frame.camera.height - 1 - frame.camera.cy;
  return result;
}

/// After ten images that are left out, come in another order, or stand on their head, the very next
/// one is what it would be without a track, as all of these are.
TEST(Tracking, AWrongTrackIsDroppedWithinOneImage) {
  const std::vector<Frame> frames = bagFrames("robot_lab.bag");
  if (frames.empty()) GTEST_SKIP() << "there is no robot_lab.bag in " << recordingsFolder();
  Follower follower;
  std::vector<Frame> disturbed;
  for (std::size_t i = 0; i < 30; ++i) disturbed.push_back(frames[i]);
  for (std::size_t i = 40; i < 50; ++i) disturbed.push_back(frames[i]);
  for (std::size_t i = 0; i < 10; ++i) disturbed.push_back(frames[i * 37 % frames.size()]);
  for (std::size_t i = 60; i < 70; ++i) disturbed.push_back(turned(frames[i]));
  for (std::size_t i = 70; i < 80; ++i) disturbed.push_back(frames[i]);
  for (std::size_t i = 0; i < 10; ++i) {  // in turns
    disturbed.push_back(i % 2 == 0 ? turned(frames[80 + i]) : frames[80 + i]);
  }
  for (std::size_t i = 0; i < disturbed.size(); ++i) {
    EXPECT_TRUE(follower.look(disturbed[i].depth, disturbed[i].camera)) << i;
  }
  EXPECT_GE(follower.tracked, 50);
}

/// A camera in the hand over a desk, rolled and pitched wildly.
class Desk : public testing::Test {
 protected:
  /// How often what was found in an image that shows a fifth of floor or table is one of them.
  struct Figures {
    int images = 0, right = 0, walls = 0, none = 0;
    std::vector<std::optional<Eigen::Vector4d>> planes;  ///< of all images; [normal, distance]
  };

  void SetUp() override {
    frames_ = bagFrames("handheld_desk.bag");
    truths_ = readDeskTruth();
    if (frames_.empty() || truths_.empty()) {
      GTEST_SKIP() << "there is no handheld_desk.bag in " << recordingsFolder();
    }
  }

  /// @param known makes the prior of an image.
  template <typename Known>
  Figures figures(const Parameters& parameters, Known&& known) const {
    Figures result;
    DominantPlaneDetector detector(parameters);
    for (const Frame& frame : frames_) {
      const DeskTruth* const truth = findTruth(truths_, std::stod(frame.name));
      if (truth == nullptr) continue;
      const Detection& d = detector.detect(frame.depth, frame.camera, known(*truth));
      result.planes.emplace_back();
      if (d.found()) {
        Eigen::Vector4d plane;
        plane << d.normal, d.distance;
        result.planes.back() = plane;
      }
      if (std::max(truth->on_floor, truth->on_table) < 0.2) continue;
      ++result.images;
      result.none += !d.found();
      if (!d.found()) continue;
      const double tilt = angleBetween(d.normal, truth->up);
      const double off =
          std::min(std::abs(d.distance - truth->floor), std::abs(d.distance - truth->table));
      result.walls += tilt > 45.0 * kDegree;
      result.right += tilt < 10.0 * kDegree && off < 0.06;
    }
    return result;
  }

  static Prior byTf(const Eigen::Vector3d& up) {
    Prior prior;
    prior.expected_up = up;
    prior.up_source = UpSource::kTf;
    return prior;
  }

  std::vector<Frame> frames_;
  std::vector<DeskTruth> truths_;
};

TEST_F(Desk, KnowingUpFloorOrTableIsFoundAndNeverAWall) {
  const Figures known = figures({}, [](const DeskTruth& truth) { return byTf(truth.up); });
  ASSERT_GE(known.images, 100);
  EXPECT_GE(known.right, static_cast<int>(std::ceil(0.97 * known.images)));
  EXPECT_EQ(known.walls, 0);
  const Figures with_height = figures({}, [](const DeskTruth& truth) {
    Prior prior = byTf(truth.up);
    prior.expected_height = Prior::ExpectedHeight{truth.floor, 0.15};
    return prior;
  });
  EXPECT_GE(with_height.right, static_cast<int>(std::ceil(0.97 * known.images)));
  EXPECT_EQ(with_height.walls, 0);
  const Figures unknown = figures({}, [](const DeskTruth&) { return Prior(); });
  Parameters any_tilt;
  any_tilt.max_tilt = 3.15;
  const Figures largest = figures(any_tilt, [](const DeskTruth&) { return Prior(); });
  std::cout << "of " << known.images << " images, right, walls and none: up known " << known.right
            << ", " << known.walls << ", " << known.none << "; and the height " << with_height.right
            << ", " << with_height.walls << ", " << with_height.none << "; nothing known "
            << unknown.right << ", " << unknown.walls << ", " << unknown.none << "; at any tilt "
            << largest.right << ", " << largest.walls << ", " << largest.none << "\n";
}

/// The normal comes from the data: a prior that is 8 degrees off, to any side, moves it in hardly
/// any image.
TEST_F(Desk, APriorThatIsOffDoesNotTurnThePlane) {
  const Figures straight = figures({}, [](const DeskTruth& truth) { return byTf(truth.up); });
  int compared = 0, moved = 0;
  for (const double side : {0.0, 0.5, 1.0, 1.5}) {
    const Figures off = figures({}, [&](const DeskTruth& truth) {
      const Eigen::Vector3d axis =
          Eigen::AngleAxisd(side * M_PI, truth.up.normalized()) * truth.up.unitOrthogonal();
      return byTf(Eigen::AngleAxisd(8.0 * kDegree, axis) * truth.up);
    });
    EXPECT_GE(off.right, static_cast<int>(std::ceil(0.97 * off.images)));
    EXPECT_EQ(off.walls, 0);
    for (std::size_t i = 0; i < straight.planes.size(); ++i) {
      if (!straight.planes[i] || !off.planes[i]) continue;
      const Eigen::Vector4d &a = *straight.planes[i], &b = *off.planes[i];
      if (std::abs(a[3] - b[3]) > 0.3) continue;  // table and floor
      ++compared;
      moved += angleBetween(a.head<3>(), b.head<3>()) > 0.5 * kDegree;
    }
  }
  std::cout << "moved by more than 0.5 deg in " << moved << " of " << compared << " images\n";
  EXPECT_GE(compared, 560);
  EXPECT_LE(moved, compared / 50);
}

}  // namespace
}  // namespace dominant_plane_detection
