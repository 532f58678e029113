#pragma once

#include <opencv2/core/mat.hpp>

#include "dominant_plane_detection/detection.h"
#include "support/recordings.h"
#include "synthetic/random_scene.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {

/// The first `count` random scenes as a sensor sees them, with the true plane and the true ground.
inline ReferenceSet loadRandomScenes(std::uint32_t count) {
  ReferenceSet set;
  set.name = "random scenes";
  set.camera = kinectCamera();
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    const Scene scene = randomScene(seed);
    const Rendering rendering =
        Renderer(scene).render(scene.path.keys.front().pose(), {true, true});
    std::vector<std::uint16_t> readings = senseDepth(rendering, scene.noise, seed);
    ReferenceImage image;
    image.name = std::to_string(seed);
    image.up = rendering.normal;
    image.height = rendering.distance;
    image.depth = cv::Mat(rendering.height, rendering.width, CV_16UC1, readings.data()).clone();
    std::vector<std::uint8_t> labels = rendering.labels;
    image.ground = cv::Mat(rendering.height, rendering.width, CV_8UC1, labels.data()) ==
                   static_cast<int>(Label::kGround);
    set.images.push_back(image);
  }
  return set;
}

}  // namespace dominant_plane_detection
