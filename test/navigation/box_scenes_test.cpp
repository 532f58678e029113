// Boxes of things in rendered rooms with the errors of sensors, against what really stands there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "navigation/ground_frame.h"
#include "navigation/obstacle_boxes.h"
#include "navigation/room_things.h"
#include "support/long_form.h"
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
  int things =
      0;  ///< [#] of 10 cm or more, within 3 m, with 5 x 5 cm in view and nothing of it cut off
  int found = 0;              ///< [#] of them with a box within 5 cm
  int sized = 0;              ///< [#] of these, each of its sizes of 10 cm or more within 30 %
  int boxes = 0, ghosts = 0;  ///< [#] and those where nothing is within 10 cm
  int images = 0;
  std::vector<double> off;  ///< [m] of the box that is nearest
};

bool within(double size, double truth) {
  return truth < 0.1 || std::abs(size - truth) < 0.3 * truth;
}

BoxFigures figuresOf(ErrorKind error, int images) {
  BoxFigures figures;
  DominantPlaneDetector detector(parametersOf(error));
  ObstacleBoxes boxes;
  RayTable rays;
  for (int seed = 1; seed <= images; ++seed) {
    const RoomOfThings room = roomOfThings(static_cast<std::uint32_t>(seed), 0.15);
    Layers layers;
    layers.shadow = true;
    const Eigen::Isometry3d pose = room.scene.path.keys.front().pose();
    const Rendering exact = Renderer(room.scene).render(pose, layers);
    const auto pixels = readDepth(exact, error, static_cast<std::uint32_t>(seed));
    const DepthView view(pixels.data(), exact.width, exact.height);
    Prior prior;
    prior.expected_up = exact.normal;
    prior.up_source = UpSource::kTf;
    prior.expected_height = Prior::ExpectedHeight{exact.distance, 0.15};
    const Detection& detection = detector.detect(view, room.scene.camera, prior);
    rays.build(room.scene.camera);
    ++figures.images;
    const auto& found = boxes.find(view, rays, detection, {});
    // The room's x is that of the frame on the ground, and its origin below the camera.
    const std::vector<Visible> seen = look(room, exact);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const Thing& thing = room.things[k];
      const bool large = thing.size.z() >= 0.1 && seen[k].size().maxCoeff() >= 0.1;
      if (!large || seen[k].area < 0.0025 || seen[k].distance > 3.0 || seen[k].cut) continue;
      ++figures.things;
      const auto nearest =
          std::min_element(found.begin(), found.end(), [&](const auto& a, const auto& b) {
            return (a.centre - seen[k].centre(thing)).norm() <
                   (b.centre - seen[k].centre(thing)).norm();
          });
      if (nearest == found.end()) continue;
      const double off = (nearest->centre - seen[k].centre(thing)).norm();
      figures.off.push_back(off);
      if (off > 0.05) {
        if (getenv("DBG"))
          printf(
              "FAR seed %d thing %.2f x %.2f x %.2f at %.2f %.2f visible %.2f x %.2f area %.4f: "
              "off %.3f box %.2f x %.2f x %.2f\n",
              seed, thing.size.x(), thing.size.y(), thing.size.z(), thing.place.x(),
              thing.place.y(), seen[k].size().x(), seen[k].size().y(), seen[k].area, off,
              nearest->length, nearest->width, nearest->top);
        continue;
      }
      ++figures.found;
      const double length = seen[k].size().maxCoeff(), width = seen[k].size().minCoeff();
      const bool sized = within(nearest->length, length) && within(nearest->width, width) &&
                         within(nearest->top - nearest->bottom, seen[k].top);
      figures.sized += sized;
      if (getenv("DBG") && !sized)
        printf("SIZE seed %d d %.2f visible %.2f x %.2f x %.2f box %.2f x %.2f x %.2f\n", seed,
               seen[k].distance, length, width, seen[k].top, nearest->length, nearest->width,
               nearest->top - nearest->bottom);
    }
    for (const UprightBox& box : found) {
      if (box.distance > 3.0) continue;
      ++figures.boxes;
      const bool real =
          std::any_of(room.things.begin(), room.things.end(),
                      [&](const Thing& thing) { return thing.distanceTo(box.centre) < 0.1; });
      figures.ghosts += !real;
      if (getenv("DBG") && !real)
        printf("GHOST seed %d at %.2f %.2f %.2f x %.2f x %.2f px %d\n", seed, box.centre.x(),
               box.centre.y(), box.length, box.width, box.top, (int)box.pixels);
    }
  }
  return figures;
}

TEST(BoxScenes, ThingsOfTenCentimetresAreFoundWithTheirSizes) {
  for (const auto& [name, error] : {std::make_pair("smooth", ErrorKind::kSmooth),
                                    std::make_pair("RealSense", ErrorKind::kRealsense),
                                    std::make_pair("Kinect", ErrorKind::kKinect)}) {
    const BoxFigures f = figuresOf(error, longForm(40, 400));
    std::cout << name << ": " << f.found << " of " << f.things << " within 5 cm, " << f.sized
              << " of the right size; " << f.ghosts << " of " << f.boxes << " boxes of nothing in "
              << f.images << " images\n";
  }
}

}  // namespace
}  // namespace dominant_plane_detection
