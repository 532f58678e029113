#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <cstdint>
#include <future>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/ros_test.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {

/// Depth images of a robot before a bin, with a Kinect's noise and shadows.
struct BinCamera {
  BinCamera() {
    const Scene scene = loadScene(DPD_SOURCE "/scenes/rubbish_bin.yaml");
    const auto rendering = Renderer(scene).render(scene.path.at(1.0).pose(), {true, false});
    pixels = senseDepth(rendering, scene.noise, 1);
    camera = scene.camera;
    image.encoding = "16UC1";
    image.width = static_cast<std::uint32_t>(rendering.width);
    image.height = static_cast<std::uint32_t>(rendering.height);
    image.step = 2 * image.width;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(pixels.data());
    image.data.assign(bytes, bytes + 2 * pixels.size());
    info.width = image.width;
    info.height = image.height;
    info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
    info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  }

  CameraModel camera;
  std::vector<std::uint16_t> pixels;  ///< [mm]
  sensor_msgs::Image image;
  sensor_msgs::CameraInfo info;
};

/// @return the option to listen for so long.
inline std::string duration(double seconds) {
  return "--duration " + std::to_string(patience() * seconds);
}

/// Runs the doctor while `publish` is called five times a second.
template <typename Publish>
Outcome runDoctor(const std::string& arguments, Publish&& publish) {
  auto outcome = std::async(std::launch::async,
                            [arguments] { return run(std::string(DPD_DOCTOR) + " " + arguments); });
  while (!isReady(outcome)) {
    publish();
    spinUntil([&] { return isReady(outcome); }, 0.2 / patience());
  }
  return outcome.get();
}

/// @return the lines that say something of a node.
inline std::vector<std::string> linesOf(const Outcome& outcome, const std::string& node) {
  std::vector<std::string> lines;
  std::istringstream stream(outcome.text);
  for (std::string line; std::getline(stream, line);) {
    if (line.find(": " + node + ": ") != std::string::npos) lines.push_back(line);
  }
  return lines;
}

}  // namespace dominant_plane_detection
