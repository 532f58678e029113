#include <pcl/features/integral_image_normal.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <algorithm>
#include <cmath>

#include "other_detectors.h"

namespace dominant_plane_detection {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr cloudOf(const cv::Mat& depth, const CameraModel& camera, int step) {
  const Cloud::Ptr cloud(new Cloud(static_cast<std::uint32_t>((depth.cols + step - 1) / step),
                                   static_cast<std::uint32_t>((depth.rows + step - 1) / step)));
  cloud->is_dense = false;
  for (int v = 0; v < depth.rows; v += step) {
    for (int u = 0; u < depth.cols; u += step) {
      const float z = depth.at<float>(v, u);
      cloud->at(u / step, v / step) = {z * static_cast<float>((u - camera.cx) / camera.fx),
                                       z * static_cast<float>((v - camera.cy) / camera.fy), z};
    }
  }
  return cloud;
}

}  // namespace

int detectWithPclOrganized(const cv::Mat& depth, const CameraModel& camera) {
  const Cloud::Ptr cloud = cloudOf(depth, camera, 1);
  pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal> estimate;
  estimate.setNormalEstimationMethod(estimate.COVARIANCE_MATRIX);
  estimate.setMaxDepthChangeFactor(0.02F);
  estimate.setNormalSmoothingSize(20.0F);
  const pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  estimate.setInputCloud(cloud);
  estimate.compute(*normals);
  pcl::OrganizedMultiPlaneSegmentation<pcl::PointXYZ, pcl::Normal, pcl::Label> segmentation;
  segmentation.setMinInliers(2000);
  segmentation.setAngularThreshold(0.05);
  segmentation.setDistanceThreshold(0.02);
  segmentation.setInputNormals(normals);
  segmentation.setInputCloud(cloud);
  std::vector<pcl::PlanarRegion<pcl::PointXYZ>,
              Eigen::aligned_allocator<pcl::PlanarRegion<pcl::PointXYZ>>>
      regions;
  segmentation.segmentAndRefine(regions);
  return static_cast<int>(regions.size());
}

int detectWithPclRansac(const cv::Mat& depth, const CameraModel& camera) {
  Cloud::Ptr cloud = cloudOf(depth, camera, 2);
  cloud->erase(std::remove_if(cloud->begin(), cloud->end(),
                              [](const pcl::PointXYZ& p) { return !std::isfinite(p.z); }),
               cloud->end());
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(0.02);
  segmentation.setMaxIterations(200);
  segmentation.setOptimizeCoefficients(true);
  segmentation.setInputCloud(cloud);
  pcl::PointIndices inliers;
  pcl::ModelCoefficients coefficients;
  segmentation.segment(inliers, coefficients);
  return static_cast<int>(inliers.indices.size());
}

}  // namespace dominant_plane_detection
