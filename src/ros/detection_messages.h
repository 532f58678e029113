#pragma once

#include <dominant_plane_detection/DominantPlane.h>
#include <dominant_plane_detection/DominantPlaneArray.h>
#include <geometry_msgs/PolygonStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <pcl_msgs/ModelCoefficients.h>
#include <pcl_msgs/PointIndices.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"
#include "navigation/ground_scan.h"
#include "navigation/local_map.h"

namespace dominant_plane_detection {

/// @param processing_time [s]
DominantPlanePtr planeMessage(const std_msgs::Header& header, const Detection& detection,
                              double processing_time);

/// @return the dominant plane and the further ones; none without a plane.
DominantPlaneArrayPtr planesMessage(const std_msgs::Header& header, const Detection& detection,
                                    double processing_time);

/// @return mono8, the number of each pixel's plane: 0 none, 1 the dominant one, 2 the first of the
/// further ones. Where these are not looked for there is the dominant one alone.
sensor_msgs::ImagePtr planeIndexMessage(const std_msgs::Header& header, const Detection& detection);

/// @return [a b c d] with a x + b y + c z + d = 0, as PCL has it.
/// @pre detection.found()
pcl_msgs::ModelCoefficientsPtr coefficientsMessage(const std_msgs::Header& header,
                                                   const Detection& detection);

/// @return mono8, 255 where the label is ground, 0 elsewhere.
sensor_msgs::ImagePtr maskMessage(const std_msgs::Header& header, const Detection& detection);

/// @return mono8, the `Label` of each pixel.
sensor_msgs::ImagePtr labelsMessage(const std_msgs::Header& header, const Detection& detection);

/// @return 32FC1, the height of each reading over the plane [m], negative below it; NaN without a
/// reading, and everywhere without a plane (REP 118).
sensor_msgs::ImagePtr heightMessage(const std_msgs::Header& header, const DepthView& depth,
                                    const RayTable& rays, const Detection& detection);

/// @param header in the frame on the ground.
sensor_msgs::LaserScanPtr scanMessage(const std_msgs::Header& header, const GroundScan& scan);

/// @param header in the frame of the map. @param height [m] of the ground in it.
nav_msgs::OccupancyGridPtr mapMessage(const std_msgs::Header& header, const LocalMap& map,
                                      double height);

/// @return the pixels that are obstacles, by their place in the depth image row by row, which is
/// that in an organised cloud of it.
pcl_msgs::PointIndicesPtr obstacleIndices(const std_msgs::Header& header,
                                          const Detection& detection);

/// @param outline [m] corners.
geometry_msgs::PolygonStampedPtr outlineMessage(const std_msgs::Header& header,
                                                const std::vector<Eigen::Vector3d>& outline);

/// The outline as a translucent sheet, with the normal as an arrow of 0.3 m in its middle; without
/// corners, the order to take both away.
visualization_msgs::MarkerArrayPtr markersMessage(const std_msgs::Header& header,
                                                  const Detection& detection,
                                                  const std::vector<Eigen::Vector3d>& outline);

/// Adds the outlines of further planes as closed lines, with a colour for each kind; they last half
/// a second.
/// @param outlines [m] corners, of each further plane.
void addFurtherPlanes(const std_msgs::Header& header, const Detection& detection,
                      const std::vector<std::vector<Eigen::Vector3d>>& outlines,
                      visualization_msgs::MarkerArray& markers);

}  // namespace dominant_plane_detection
