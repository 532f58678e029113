#include "support/recordings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>

namespace dominant_plane_detection {
namespace {

/// What stands on the floor although the reference mask, closed, has it as floor: edges and feet of
/// stands and boxes, and a thing 2 m ahead that stays where it is in four images. Found by eye.
void loadObjects(ReferenceSet& set) {
  std::ifstream file(DPD_REAL_OBJECTS);
  if (!file) throw std::runtime_error(std::string("cannot read ") + DPD_REAL_OBJECTS);
  std::string line;
  std::getline(file, line);  // header
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    std::string name, image_name;
    int left, top, right, bottom;
    if (!(fields >> name >> image_name >> left >> top >> right >> bottom)) {
      throw std::runtime_error("expected set, image, left, top, right, bottom, got " + line);
    }
    if (name != set.name || set.images.empty()) continue;
    const auto image =
        std::find_if(set.images.begin(), set.images.end(),
                     [&](const ReferenceImage& each) { return each.name == image_name; });
    if (image == set.images.end()) throw std::runtime_error("no image for " + line);
    image->objects.emplace_back(cv::Point(left, top), cv::Point(right, bottom));
  }
}

ReferenceSet load(const std::string& name, const Eigen::Vector4d& intrinsics,
                  float metres_per_unit) {
  ReferenceSet set;
  set.name = name;
  set.camera.width = 640;
  set.camera.height = 480;
  set.camera.fx = intrinsics[0];
  set.camera.fy = intrinsics[1];
  set.camera.cx = intrinsics[2];
  set.camera.cy = intrinsics[3];
  set.metres_per_unit = metres_per_unit;
  loadImages(recordingsFolder() + "/" + name, set);
  loadObjects(set);
  return set;
}

}  // namespace

DepthView ReferenceSet::view(const ReferenceImage& image) const {
  DepthView view;
  view.data = image.depth.data;
  view.width = image.depth.cols;
  view.height = image.depth.rows;
  view.step = image.depth.step;
  view.metres_per_unit = metres_per_unit;
  return view;
}

Eigen::Vector3d ReferenceSet::point(const DepthView& depth, int u, int v) const {
  return static_cast<double>(metresAt(depth, u, v)) * camera.ray({u, v}).homogeneous();
}

std::string recordingsFolder() {
  const char* folder = std::getenv("DPD_RECORDINGS");
  return folder != nullptr ? folder : DPD_DEFAULT_RECORDINGS;
}

ReferenceSet loadRobotLab() {
  return load("robot_lab_reference", {383.8, 383.8, 321.7, 236.8}, 0.001F);
}

ReferenceSet loadCabinet() { return load("cabinet", {535.4, 539.2, 320.1, 247.6}, 0.0002F); }

ReferenceSet loadLowRobot() {
  ReferenceSet set = load("low_robot", {617.25, 617.5486, 317.392, 245.98}, 0.001F);
  set.range_min = 0.1;
  return set;
}

void loadImages(const std::string& folder, ReferenceSet& set) {
  std::ifstream file(folder + "/reference.csv");
  std::string line;
  std::getline(file, line);  // header
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    ReferenceImage image;
    fields >> image.name >> image.up.x() >> image.up.y() >> image.up.z() >> image.height;
    image.depth = cv::imread(folder + "/depth/" + image.name + ".png", cv::IMREAD_UNCHANGED);
    image.ground = cv::imread(folder + "/mask/" + image.name + ".png", cv::IMREAD_GRAYSCALE);
    set.images.push_back(image);
  }
}

}  // namespace dominant_plane_detection
