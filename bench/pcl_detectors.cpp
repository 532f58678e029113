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

using Organized = pcl::OrganizedMultiPlaneSegmentation<pcl::PointXYZ, pcl::Normal, pcl::Label>;

using Regions = std::vector<pcl::PlanarRegion<pcl::PointXYZ>,
                            Eigen::aligned_allocator<pcl::PlanarRegion<pcl::PointXYZ>>>;

void setUp(const Cloud::Ptr& cloud, Organized& segmentation) {
  pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal> estimate;
  estimate.setNormalEstimationMethod(estimate.COVARIANCE_MATRIX);
  estimate.setMaxDepthChangeFactor(0.02F);
  estimate.setNormalSmoothingSize(20.0F);
  const pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  estimate.setInputCloud(cloud);
  estimate.compute(*normals);
  segmentation.setMinInliers(2000);
  segmentation.setAngularThreshold(0.05);
  segmentation.setDistanceThreshold(0.02);
  segmentation.setInputNormals(normals);
  segmentation.setInputCloud(cloud);
}

}  // namespace

int detectWithPclOrganized(const cv::Mat& depth, const CameraModel& camera) {
  Organized segmentation;
  setUp(cloudOf(depth, camera, 1), segmentation);
  Regions regions;
  segmentation.segmentAndRefine(regions);
  return static_cast<int>(regions.size());
}

cv::Mat largestWithPclOrganized(const cv::Mat& depth, const CameraModel& camera) {
  Organized segmentation;
  setUp(cloudOf(depth, camera, 1), segmentation);
  Regions regions;
  std::vector<pcl::ModelCoefficients> coefficients;
  std::vector<pcl::PointIndices> inliers, label_indices, boundaries;
  pcl::PointCloud<pcl::Label>::Ptr labels(new pcl::PointCloud<pcl::Label>);
  segmentation.segmentAndRefine(regions, coefficients, inliers, labels, label_indices, boundaries);
  cv::Mat mask = cv::Mat::zeros(depth.size(), CV_8U);
  const auto largest = std::max_element(
      inliers.begin(), inliers.end(),
      [](const auto& a, const auto& b) { return a.indices.size() < b.indices.size(); });
  if (largest == inliers.end()) return mask;
  for (const int index : largest->indices) mask.data[index] = 255;
  return mask;
}

Eigen::Vector4f detectWithPclRansac(const cv::Mat& depth, const CameraModel& camera) {
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
  if (coefficients.values.size() != 4) return Eigen::Vector4f::Zero();
  return Eigen::Vector4f(coefficients.values.data());
}

}  // namespace dominant_plane_detection
