#pragma once

#include <dominant_plane_detection/DominantPlane.h>
#include <geometry_msgs/PolygonStamped.h>
#include <pcl_msgs/ModelCoefficients.h>
#include <sensor_msgs/Image.h>
#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {

/// @param processing_time [s]
DominantPlanePtr planeMessage(const std_msgs::Header& header, const Detection& detection,
                              double processing_time);

/// @return [a b c d] with a x + b y + c z + d = 0, as PCL has it.
/// @pre detection.found()
pcl_msgs::ModelCoefficientsPtr coefficientsMessage(const std_msgs::Header& header,
                                                   const Detection& detection);

/// @return mono8, 255 where the label is ground, 0 elsewhere.
sensor_msgs::ImagePtr maskMessage(const std_msgs::Header& header, const Detection& detection);

/// @return mono8, the `Label` of each pixel.
sensor_msgs::ImagePtr labelsMessage(const std_msgs::Header& header, const Detection& detection);

/// @param outline [m] corners.
geometry_msgs::PolygonStampedPtr outlineMessage(const std_msgs::Header& header,
                                                const std::vector<Eigen::Vector3d>& outline);

/// The outline as a translucent sheet, with the normal as an arrow of 0.3 m in its middle; without
/// corners, the order to take both away.
visualization_msgs::MarkerArrayPtr markersMessage(const std_msgs::Header& header,
                                                  const Detection& detection,
                                                  const std::vector<Eigen::Vector3d>& outline);

}  // namespace dominant_plane_detection
