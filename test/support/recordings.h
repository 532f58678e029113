#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// A depth image with what is known to be true about it.
struct ReferenceImage {
  std::string name;
  cv::Mat depth;                                 ///< 16-bit
  cv::Mat ground;                                ///< 8-bit, 255 = ground
  std::vector<cv::Rect> objects;                 ///< [px] what stands on it, found by eye
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< [-] normal towards the camera, optical frame
  double height = 0.0;                           ///< [m] camera over the plane
};

/// Depth images with masks and planes: a folder of them (depth/, mask/, reference.csv), or scenes.
struct ReferenceSet {
  std::string name;
  CameraModel camera;
  float metres_per_unit = 0.001F;  ///< [m]
  double range_min = 0.5;          ///< [m] working range
  double range_max = 4.0;          ///< [m]
  /// Whether the planes are the truth itself. Those of recordings are least-squares fits to the
  /// same readings, as the detector's are: with them it can agree, and share their error.
  bool exact = false;
  std::vector<ReferenceImage> images;

  DepthView view(const ReferenceImage& image) const;
  /// @return [m] what a pixel shows, in the optical frame; 0 without a reading.
  Eigen::Vector3d point(const DepthView& depth, int u, int v) const;
};

/// @return the folder with the recordings: DPD_RECORDINGS, or else the one the build was told.
std::string recordingsFolder();

/// The reference sets by their names in the folder of recordings.
/// @return a set without images where the folder is missing.
ReferenceSet loadRobotLab();
ReferenceSet loadCabinet();
ReferenceSet loadLowRobot();

/// Reads `folder`/depth, `folder`/mask and `folder`/reference.csv into the set.
void loadImages(const std::string& folder, ReferenceSet& set);

}  // namespace dominant_plane_detection
