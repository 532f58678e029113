// A camera in a walking hand, before tables and walls that are larger than what it sees of the
// floor: an accelerometer that feels the hand's motion has to be enough.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <random>

#include "prior/gravity_filter.h"
#include "prior/known_up.h"
#include "prior/plane_track.h"
#include "support/long_form.h"
#include "support/surface_figures.h"
#include "synthetic/camera_rays.h"
#include "synthetic/drawn_scene.h"
#include "synthetic/renderer.h"
#include "synthetic/scene_random.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kTable = 0.74;     // [m]
constexpr double kReadings = 30.0;  // [Hz] of a Kinect's accelerometer
constexpr double kImages = 10.0;    // [Hz] that are looked at
constexpr double kDuration = 2.5;   // [s]

/// How a hand moves that walks: steps twice a second, sway once, and turns as one looks about.
struct Walk {
  Eigen::Vector3d begin;                   ///< [m]
  double heading, speed;                   ///< [rad], [m/s]
  double pitch, roll;                      ///< [rad] means
  double look_pitch, look_yaw, look_roll;  ///< [rad] amplitudes of slow turns
  double phase;                            ///< [rad]

  KeyPose at(double time) const {
    const double step = 2.0 * M_PI * 1.9 * time + phase, sway = 0.5 * step;
    const double slow = 2.0 * M_PI * 0.35 * time + 2.0 * phase;
    KeyPose pose;
    pose.time = time;
    const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading));
    const Eigen::Vector2d aside(-ahead.y(), ahead.x());
    // Amplitudes of 1.5, 2 and 1 cm: 2.1, 0.7 and 1.4 m/s^2.
    pose.position.head<2>() = begin.head<2>() +
                              (speed * time + 0.01 * std::sin(step + 1.0)) * ahead +
                              0.02 * std::sin(sway) * aside;
    pose.position.z() = begin.z() + 0.015 * std::sin(step);
    pose.pitch = pitch + look_pitch * std::sin(slow) + 1.0 * kDegree * std::sin(step + 0.5);
    pose.roll = roll + look_roll * std::sin(1.3 * slow) + 1.5 * kDegree * std::sin(sway + 0.3);
    pose.yaw = heading + look_yaw * std::sin(0.8 * slow);
    return pose;
  }
  /// @return [m/s^2] what an accelerometer in the camera feels.
  Eigen::Vector3d felt(double time) const {
    constexpr double kStep = 1e-3;
    const auto place = [&](double t) { return at(t).position; };
    const Eigen::Vector3d acceleration =
        (place(time + kStep) - 2.0 * place(time) + place(time - kStep)) / (kStep * kStep);
    return at(time).pose().linear().transpose() * (acceleration + 9.81 * Eigen::Vector3d::UnitZ());
  }
};

struct Room {
  Scene scene;
  Walk walk;
  std::vector<Eigen::Vector2d> walls;  ///< [m] the foot of the perpendicular from the origin
};

/// A table ahead, walls about, and the floor at the camera's feet and under the table.
Room draw(std::uint32_t seed) {
  SceneRandom random(seed);
  Room room;
  Scene& scene = room.scene;
  scene.camera = kinectCamera();
  scene.add(rectangleMesh(30.0, 30.0), Eigen::Isometry3d::Identity()).ground = true;
  for (const double side : {0.0, 0.5 * M_PI, -0.5 * M_PI, M_PI}) {
    const double away = random.between(1.8, 3.5), direction = side + random.between(-0.2, 0.2);
    const Eigen::Vector2d foot(away * std::cos(direction), away * std::sin(direction));
    place(scene, boxMesh({0.1, 16.0, 2.5}), {1.02 * foot.x(), 1.02 * foot.y(), 0.0}, direction);
    room.walls.push_back(foot);
  }
  const Eigen::Vector3d size(random.between(0.8, 1.6), random.between(0.7, 1.2), 0.03);
  place(scene, boxMesh(size), {random.between(0.9, 1.5), random.between(-0.6, 0.6), kTable - 0.03},
        random.between(-0.5, 0.5));
  room.walk = {{0.0, 0.0, random.between(1.2, 1.6)},
               random.between(-0.6, 0.6),
               random.between(0.0, 0.5),
               random.between(15.0, 45.0) * kDegree,
               random.between(-25.0, 25.0) * kDegree,
               random.between(2.0, 10.0) * kDegree,
               random.between(5.0, 25.0) * kDegree,
               random.between(2.0, 10.0) * kDegree,
               random.between(-M_PI, M_PI)};
  return room;
}

/// @return whether the floor is at least 15 % of the readings, and a table or a wall larger.
bool isHard(const Room& room, const Rendering& exact, const Eigen::Isometry3d& camera) {
  std::map<int, int> pixels;  // -1 floor, -2 table, others walls
  int all = 0;
  const std::vector<Eigen::Vector2f> rays = cameraRays(room.scene.camera);
  for (std::size_t i = 0; i < exact.depth.size(); i += 7) {
    const float depth = exact.depth[i];
    if (!(depth > 0.5F && depth < 4.0F)) continue;
    ++all;
    const Eigen::Vector3d at = camera * (depth * rays[i].homogeneous()).cast<double>();
    if (exact.labels[i] == static_cast<std::uint8_t>(Label::kGround)) {
      ++pixels[-1];
    } else if (std::abs(at.z() - kTable) < 0.002) {
      ++pixels[-2];
    } else {
      for (std::size_t k = 0; k < room.walls.size(); ++k) {
        const Eigen::Vector2d& foot = room.walls[k];
        if (std::abs(at.head<2>().dot(foot.normalized()) - foot.norm()) < 0.1) {
          ++pixels[static_cast<int>(k)];
        }
      }
    }
  }
  int largest = 0;
  for (const auto& [what, count] : pixels)
    largest = what == -1 ? largest : std::max(largest, count);
  return pixels[-1] > 0.15 * all && largest > pixels[-1];
}

struct Figures {
  int images = 0, floor = 0, floor_alone = 0;
  double worst = 0.0;  ///< [rad] of up by gravity
};

/// What the nodelet does with readings and images, in their order.
void walk(std::uint32_t seed, Figures& figures) {
  const Room room = draw(seed);
  const Renderer renderer(room.scene);
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, 0.17);  // [m/s^2] a Kinect's
  GravityFilter gravity;
  UpChoice choice;
  PlaneTrack track;
  DominantPlaneDetector knowing(parametersOf(ErrorKind::kKinect)),
      alone(parametersOf(ErrorKind::kKinect));
  for (int i = 0; i < static_cast<int>(kDuration * kReadings); ++i) {
    const double time = i / kReadings;
    const Eigen::Vector3d error(noise(generator), noise(generator), noise(generator));
    gravity.add({time, room.walk.felt(time) + error, std::nullopt});
    if (i % static_cast<int>(kReadings / kImages) != 0 || time < 0.5) continue;
    const Eigen::Isometry3d camera = room.walk.at(time).pose();
    Layers layers;
    layers.shadow = true;
    const Rendering exact = renderer.render(camera, layers);
    const auto pixels =
        readDepth(exact, ErrorKind::kKinect, 1000 * seed + static_cast<unsigned>(i));
    const DepthView view(pixels.data(), exact.width, exact.height);
    Prior prior;
    const auto known = choice.choose(time, {std::nullopt, gravity.up(time), "", ""});
    if (known) {
      prior.expected_up = known->up.direction;
      prior.up_source = known->source;
      prior.up_error = known->up.error;
      figures.worst =
          std::max(figures.worst, std::acos(std::min(1.0, known->up.direction.dot(exact.normal))));
    }
    prior.predicted_plane = track.predict(time, {});
    const Detection& detection = knowing.detect(view, room.scene.camera, prior);
    track.add(time, detection, std::nullopt);
    if (!isHard(room, exact, camera)) continue;
    const auto is_floor = [&](const Detection& d) {
      return d.found() && d.normal.dot(exact.normal) > std::cos(10.0 * kDegree) &&
             std::abs(d.distance - exact.distance) < 0.1;
    };
    ++figures.images;
    figures.floor += is_floor(detection);
    figures.floor_alone += is_floor(alone.detect(view, room.scene.camera));
  }
}

TEST(KnownGravity, TheFloorIsChosenByAWalkingHand) {
  Figures figures;
  const int walks = longForm(20, 200);
  for (int seed = 1; seed <= walks; ++seed) walk(static_cast<std::uint32_t>(seed), figures);
  std::cout << "the floor in " << figures.floor << " of " << figures.images
            << " images, without an accelerometer in " << figures.floor_alone
            << "; up by gravity was off by up to " << figures.worst / kDegree << " deg\n";
  EXPECT_GE(figures.images, 5 * walks);
  EXPECT_GE(figures.floor, 0.98 * figures.images);
  EXPECT_LT(figures.floor_alone, 0.9 * figures.images);
}

}  // namespace
}  // namespace dominant_plane_detection
