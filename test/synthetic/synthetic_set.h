#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "dominant_plane_detection/detection.h"
#include "support/recordings.h"
#include "synthetic/random_scene.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {

/// What a sensor sees of a scene from its first key pose, with the true plane and the true ground.
inline ReferenceImage senseScene(const Scene& scene, const SensorNoise& noise,
                                 std::uint32_t frame) {
  const Rendering rendering =
      Renderer(scene).render(scene.path.keys.front().pose(), {noise.shadows, false, false});
  std::vector<std::uint16_t> readings = senseDepth(rendering, noise, frame);
  ReferenceImage image;
  image.name = std::to_string(frame);
  image.up = rendering.normal;
  image.height = rendering.distance;
  image.depth = cv::Mat(rendering.height, rendering.width, CV_16UC1, readings.data()).clone();
  std::vector<std::uint8_t> labels = rendering.labels;
  image.ground = cv::Mat(rendering.height, rendering.width, CV_8UC1, labels.data()) ==
                 static_cast<int>(Label::kGround);
  return image;
}

/// The first `count` random scenes as a sensor sees them.
inline ReferenceSet loadRandomScenes(std::uint32_t count, const SensorNoise& noise,
                                     const std::string& name) {
  ReferenceSet set;
  set.name = name;
  set.camera = kinectCamera();
  set.exact = true;
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    set.images.push_back(senseScene(randomScene(seed), noise, seed));
  }
  return set;
}

/// With errors that are independent from pixel to pixel, as the thresholds assume.
inline ReferenceSet loadRandomScenes(std::uint32_t count) {
  return loadRandomScenes(count, SensorNoise::independent(), "random scenes");
}

/// With the smooth error of a Kinect.
inline ReferenceSet loadSmoothRandomScenes(std::uint32_t count) {
  return loadRandomScenes(count, SensorNoise{}, "random scenes, smooth error");
}

}  // namespace dominant_plane_detection
