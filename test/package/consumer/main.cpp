// A program of somebody else's: prints the plane that it finds in an exact picture of one.

#include <dominant_plane_detection/dominant_plane_detector.h>

#include <cstdio>
#include <vector>

int main() {
  namespace dpd = dominant_plane_detection;
  dpd::CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525.0;
  camera.cx = 319.5;
  camera.cy = 239.5;

  // 0.8 y + 0.6 z = 1: seen from 1 m, along a ray (x, y, 1) at z = 1 / (0.8 y + 0.6).
  std::vector<float> metres;
  for (int v = 0; v < camera.height; ++v) {
    const double y = (v - camera.cy) / camera.fy;
    metres.insert(metres.end(), camera.width, static_cast<float>(1.0 / (0.8 * y + 0.6)));
  }
  dpd::DepthView depth;
  depth.data = metres.data();
  depth.width = camera.width;
  depth.height = camera.height;
  depth.step = camera.width * sizeof(float);
  depth.type = dpd::DepthView::Type::kFloat32;

  dpd::DominantPlaneDetector detector;
  const dpd::Detection& detection = detector.detect(depth, camera);
  std::printf("%s %.6f %.6f %.6f %.6f\n", dpd::stateName(detection.state), detection.normal.x(),
              detection.normal.y(), detection.normal.z(), detection.distance);
}
