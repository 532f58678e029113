// Boxes of things in rendered rooms with the errors of sensors, against what really stands there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "navigation/ground_frame.h"
#include "navigation/obstacle_boxes.h"
#include "navigation/room_things.h"
#include "support/long_form.h"
#include "support/recordings.h"
#include "support/surface_figures.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {
namespace {

/// What an exact image shows of a thing, in the thing's own axes.
struct Visible {
  double area = 0.0;  ///< [m^2] seen from the camera
  Eigen::Vector2d low = Eigen::Vector2d::Constant(INFINITY), high = -low;  ///< [m] of its middle
  double top = 0.0;                                                        ///< [m]
  double distance = INFINITY;  ///< [m] from below the camera
  bool cut = false;            ///< the image's border goes through it

  Eigen::Vector2d size() const { return high - low; }
  Eigen::Vector2d centre(const Thing& thing) const {
    return thing.place + Eigen::Rotation2Dd(thing.yaw) * Eigen::Vector2d(0.5 * (low + high));
  }
};

std::vector<Visible> look(const RoomOfThings& room, const Rendering& exact) {
  std::vector<Visible> seen(room.things.size());
  const CameraModel& camera = room.scene.camera;
  RayTable rays;
  rays.build(camera);
  const Eigen::Isometry3d pose = room.scene.path.keys.front().pose();
  for (int v = 0; v < exact.height; ++v) {
    for (int u = 0; u < exact.width; ++u) {
      const std::size_t i = static_cast<std::size_t>(v * exact.width + u);
      const double z = static_cast<double>(exact.depth[i]);
      if (!(z > 0.0) || exact.labels[i] != static_cast<std::uint8_t>(Label::kObstacle)) continue;
      const Eigen::Vector3d at = pose * (z * rays.ray(u, v).cast<double>());
      for (std::size_t k = 0; k < room.things.size(); ++k) {
        if (!room.things[k].contains(at)) continue;
        Visible& visible = seen[k];
        visible.area += z * z / (camera.fx * camera.fy);
        const Eigen::Vector2d inside = room.things[k].inside(at.head<2>());
        visible.low = visible.low.cwiseMin(inside);
        visible.high = visible.high.cwiseMax(inside);
        visible.top = std::max(visible.top, at.z());
        visible.distance = std::min(visible.distance, (at - pose.translation()).head<2>().norm());
        visible.cut =
            visible.cut || u == 0 || v == 0 || u + 1 == exact.width || v + 1 == exact.height;
        break;
      }
    }
  }
  return seen;
}

struct BoxFigures {
  /// [#] things of 10 cm or more, within 3 m, of which 5 x 5 cm are in view and nothing is cut off
  /// by the image's border
  int things = 0;
  int found = 0;              ///< [#] of them with a box over its visible part, within 15 cm
  int placed = 0;             ///< [#] of these within 5 cm
  int sized = 0;              ///< [#] of these, each of its sizes of 10 cm or more within 30 %
  int boxes = 0, ghosts = 0;  ///< [#] within 3 m, and those where nothing is within 10 cm
  int images = 0;
};

bool within(double size, double truth) {
  return truth < 0.1 || std::abs(size - truth) < 0.3 * truth;
}

void judgeThings(const RoomOfThings& room, const std::vector<Visible>& seen,
                 const std::vector<UprightBox>& boxes, BoxFigures& figures) {
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const Visible& visible = seen[k];
    const bool large = room.things[k].size.z() >= 0.1 && visible.size().maxCoeff() >= 0.1;
    if (!large || visible.area < 0.0025 || visible.distance > 3.0 || visible.cut) continue;
    ++figures.things;
    const Eigen::Vector2d truth = visible.centre(room.things[k]);
    const auto nearest =
        std::min_element(boxes.begin(), boxes.end(), [&](const UprightBox& a, const UprightBox& b) {
          return (a.centre - truth).norm() < (b.centre - truth).norm();
        });
    const double off = nearest == boxes.end() ? INFINITY : (nearest->centre - truth).norm();
    if (off > 0.15) continue;
    ++figures.found;
    if (off > 0.05) continue;
    ++figures.placed;
    figures.sized += within(nearest->length, visible.size().maxCoeff()) &&
                     within(nearest->width, visible.size().minCoeff()) &&
                     within(nearest->top - nearest->bottom, visible.top);
  }
}

void judgeBoxes(const RoomOfThings& room, const std::vector<UprightBox>& boxes,
                BoxFigures& figures) {
  for (const UprightBox& box : boxes) {
    if (box.distance > 3.0) continue;
    ++figures.boxes;
    figures.ghosts += std::none_of(room.things.begin(), room.things.end(), [&](const Thing& thing) {
      return thing.distanceTo(box.centre) < 0.1;
    });
  }
}

BoxFigures figuresOf(ErrorKind error, int images) {
  BoxFigures figures;
  DominantPlaneDetector detector(parametersOf(error));
  ObstacleBoxes finder;
  RayTable rays;
  for (int seed = 1; seed <= images; ++seed) {
    const RoomOfThings room = roomOfThings(static_cast<std::uint32_t>(seed), 0.15);
    Layers layers;
    layers.shadow = true;
    const Rendering exact =
        Renderer(room.scene).render(room.scene.path.keys.front().pose(), layers);
    const auto pixels = readDepth(exact, error, static_cast<std::uint32_t>(seed));
    const DepthView view(pixels.data(), exact.width, exact.height);
    Prior prior;
    prior.expected_up = exact.normal;
    prior.up_source = UpSource::kTf;
    prior.expected_height = Prior::ExpectedHeight{exact.distance, 0.15};
    const Detection& detection = detector.detect(view, room.scene.camera, prior);
    rays.build(room.scene.camera);
    // The room's x is that of the frame on the ground, and its origin is below the camera.
    const auto& boxes = finder.find(view, rays, detection, {}, detector.parameters().local_error);
    judgeThings(room, look(room, exact), boxes, figures);
    judgeBoxes(room, boxes, figures);
    ++figures.images;
  }
  return figures;
}

void print(const char* name, const BoxFigures& f) {
  std::cout << name << ": of " << f.things << " things " << f.found << " found, " << f.placed
            << " within 5 cm, " << f.sized << " of these of the right size; " << f.ghosts << " of "
            << f.boxes << " boxes of nothing in " << f.images << " images\n";
}

TEST(BoxScenes, ThingsOfTenCentimetresAreFoundWithTheirSizes) {
  const BoxFigures f = figuresOf(ErrorKind::kSmooth, longForm(40, 400));
  print("smooth errors", f);
  ASSERT_GT(f.things, f.images);
  EXPECT_GE(f.placed, 0.95 * f.things);
  EXPECT_GE(f.sized, 0.95 * f.placed);
  EXPECT_LE(f.ghosts, 0.05 * f.images);
}

/// Whose errors on the floor are as large as things are high; in simulation, larger than on the
/// floors of recordings.
TEST(BoxScenes, ErrorsOfSensorsAreAsLargeAsThat) {
  for (const auto& [name, error] : {std::make_pair("RealSense", ErrorKind::kRealsense),
                                    std::make_pair("Kinect", ErrorKind::kKinect)}) {
    const BoxFigures f = figuresOf(error, longForm(20, 400));
    print(name, f);
    EXPECT_GE(f.found, 0.8 * f.things) << name;
    EXPECT_LE(f.ghosts, 2.5 * f.images) << name;
  }
}

/// @return whether most of the obstacle pixels that are in a box are ground in the mask, and none
/// of what was found by eye to stand there.
bool isOfGround(const UprightBox& box, const ReferenceSet& set, const ReferenceImage& image,
                const Detection& detection, const RayTable& rays) {
  const Eigen::Isometry3d frame = groundFromOptical(detection.normal, detection.distance);
  int all = 0, ground = 0;
  for (int v = 0; v < detection.image_height; ++v) {
    for (int u = 0; u < detection.image_width; ++u) {
      if (detection.label(u, v) != Label::kObstacle) continue;
      const double z = static_cast<double>(metresAt(set.view(image), u, v));
      const Eigen::Vector3d at = frame * (z * rays.ray(u, v).cast<double>());
      const Eigen::Vector2d inside = Eigen::Rotation2Dd(-box.yaw) * (at.head<2>() - box.centre);
      if (std::abs(inside.x()) > 0.5 * box.length || std::abs(inside.y()) > 0.5 * box.width ||
          at.z() > box.top) {
        continue;
      }
      for (const cv::Rect& object : image.objects) {
        if (object.contains({u, v})) return false;
      }
      ++all;
      ground += image.ground.at<std::uint8_t>(v, u) != 0;
    }
  }
  return 2 * ground > all;
}

/// Boxes on floors of recordings are of things.
TEST(BoxScenes, FloorsOfRecordingsHaveFewBoxesOfNothing) {
  const std::vector<ReferenceSet> sets = {loadRobotLab(), loadCabinet()};
  if (sets[0].images.empty() && sets[1].images.empty()) GTEST_SKIP() << "there are no recordings";
  for (const ReferenceSet& set : sets) {
    if (set.images.empty()) continue;
    Parameters parameters;
    parameters.range_min = set.range_min;
    parameters.range_max = set.range_max;
    DominantPlaneDetector detector(parameters);
    ObstacleBoxes finder;
    RayTable rays;
    rays.build(set.camera);
    int boxes = 0, ghosts = 0;
    for (const ReferenceImage& image : set.images) {
      const Detection& detection = detector.detect(set.view(image), set.camera);
      for (const UprightBox& box :
           finder.find(set.view(image), rays, detection, {}, parameters.local_error)) {
        if (box.distance > 3.0) continue;
        ++boxes;
        ghosts += isOfGround(box, set, image, detection, rays);
      }
    }
    std::cout << set.name << ": " << ghosts << " of " << boxes << " boxes are of the floor, in "
              << set.images.size() << " images\n";
    EXPECT_LE(5 * ghosts, static_cast<int>(set.images.size())) << set.name;
    EXPECT_GE(boxes, static_cast<int>(set.images.size())) << set.name;
  }
}

}  // namespace
}  // namespace dominant_plane_detection
