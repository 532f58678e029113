#pragma once

#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/buffer.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/ros_test.h"

namespace dominant_plane_detection {

/// What costmap_2d's VoxelLayer, which Debian does not have, does with the sources of the recipe in
/// docs/robot.md: it takes a cloud's points between two heights of the global frame; those of
/// clearing sources clear the voxels on the way to them from the sensor, but for the last two
/// cells, then those of marking sources mark theirs. A column without a marked voxel is free where
/// one was cleared. Other things that it does, such as footprints, are left out.
class CostmapContract {
 public:
  enum Cost { kUnknown, kFree, kLethal };

  /// @param prefix the detection's name here, instead of that in the recipe.
  CostmapContract(ros::NodeHandle& node, tf2_ros::Buffer& buffer, const std::string& global_frame,
                  const std::string& prefix)
      : buffer_(buffer), global_frame_(global_frame) {
    const YAML::Node layer = recipe()["voxel_layer"];
    voxel_height_ = layer["z_resolution"].as<double>();
    origin_z_ = layer["origin_z"].as<double>();
    voxels_ = layer["z_voxels"].as<int>();
    std::istringstream names(layer["observation_sources"].as<std::string>());
    for (std::string name; names >> name;) addSource(node, layer[name], prefix);
  }

  bool connected() const {
    return std::all_of(sources_.begin(), sources_.end(),
                       [](const Source& source) { return source.clouds->connected(); });
  }
  /// Takes the clouds of an image, once all are there and tf is.
  /// @return whether they are.
  bool update(const ros::Time& stamp) {
    for (const Source& source : sources_) {
      if (source.clouds->size() == 0 || source.clouds->last()->header.stamp != stamp) return false;
      if (!buffer_.canTransform(global_frame_, source.clouds->last()->header.frame_id, stamp)) {
        return false;
      }
    }
    for (const Source& source : sources_) {
      if (!source.clearing) continue;
      forEachPoint(source,
                   [&](const auto& o, const auto& p) { clear(o, p, source.raytrace_range); });
    }
    for (const Source& source : sources_) {
      if (source.marking) forEachPoint(source, [&](const auto& o, const auto& p) { mark(o, p); });
    }
    return true;
  }
  Cost at(const Eigen::Vector3d& place) const {
    const auto column = columns_.find(columnOf(place));
    if (column == columns_.end()) return kUnknown;
    return column->second == 0 ? kFree : kLethal;
  }
  int lethalCells() const {
    int count = 0;
    for (const auto& [column, marked] : columns_) count += marked != 0;
    return count;
  }
  /// @param corners two of a rectangle along the axes of the frame they were given in, roughly.
  int lethalCells(const std::vector<Eigen::Vector3d>& corners) const {
    const Eigen::Vector2d middle = 0.5 * (corners[0] + corners[1]).head<2>();
    const double reach = 0.5 * (corners[0] - corners[1]).head<2>().norm();
    int count = 0;
    for (const auto& [column, marked] : columns_) {
      const Eigen::Vector2d at(kCell * (column.first + 0.5), kCell * (column.second + 0.5));
      count += marked != 0 && (at - middle).norm() <= reach;
    }
    return count;
  }

 private:
  static constexpr double kCell = 0.05;
  using Column = std::pair<int, int>;
  struct Source {
    std::shared_ptr<Listener<sensor_msgs::PointCloud2>> clouds;
    bool marking, clearing;
    double min_height, max_height, obstacle_range, raytrace_range;
  };

  /// @return the first indented block of docs/robot.md that begins with voxel_layer.
  static YAML::Node recipe() {
    std::ifstream file(std::string(DPD_SOURCE) + "/docs/robot.md");
    std::string text;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
      inside = line == "    voxel_layer:" || (inside && line.rfind("    ", 0) == 0);
      if (inside) text += line.substr(4) + "\n";
    }
    const YAML::Node node = YAML::Load(text);
    if (!node["voxel_layer"]) throw std::runtime_error("docs/robot.md has no voxel_layer");
    return node;
  }
  void addSource(ros::NodeHandle& node, const YAML::Node& source, const std::string& prefix) {
    const std::string usual = "/camera/plane_detection";
    const auto topic = source["topic"].as<std::string>();
    if (topic.rfind(usual, 0) != 0 || source["data_type"].as<std::string>() != "PointCloud2") {
      throw std::runtime_error("docs/robot.md: expected clouds of the detection, got " + topic);
    }
    sources_.push_back(
        {std::make_shared<Listener<sensor_msgs::PointCloud2>>(node,
                                                              prefix + topic.substr(usual.size())),
         source["marking"].as<bool>(), source["clearing"].as<bool>(),
         source["min_obstacle_height"].as<double>(), source["max_obstacle_height"].as<double>(),
         source["obstacle_range"].as<double>(3.0), source["raytrace_range"].as<double>(3.0)});
  }

  /// @param visit called with the sensor's place and that of a point, in the global frame.
  template <typename Visit>
  void forEachPoint(const Source& source, Visit&& visit) const {
    const sensor_msgs::PointCloud2& cloud = *source.clouds->last();
    const Eigen::Isometry3d sensor = tf2::transformToEigen(
        buffer_.lookupTransform(global_frame_, cloud.header.frame_id, cloud.header.stamp));
    sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x");
    for (; x != x.end(); ++x) {
      const Eigen::Vector3d point = sensor * Eigen::Vector3f(x[0], x[1], x[2]).cast<double>();
      if (point.z() < source.min_height || point.z() > source.max_height) continue;
      const double away = (point - sensor.translation()).norm();
      if (source.marking && away > source.obstacle_range) continue;
      visit(Eigen::Vector3d(sensor.translation()), point);
    }
  }
  static Column columnOf(const Eigen::Vector3d& place) {
    return {static_cast<int>(std::floor(place.x() / kCell)),
            static_cast<int>(std::floor(place.y() / kCell))};
  }
  std::uint32_t voxelOf(double z) const {
    const int level = static_cast<int>(std::floor((z - origin_z_) / voxel_height_));
    return level < 0 || level >= voxels_ ? 0U : 1U << level;
  }
  void clear(const Eigen::Vector3d& from, const Eigen::Vector3d& point, double range) {
    const double away = (point - from).norm(), end = std::min(away - 2.0 * kCell, range);
    if (end <= 0.0) return;
    const Eigen::Vector3d to = from + end / away * (point - from);
    const int steps = static_cast<int>(std::ceil(2.0 * (to - from).norm() / kCell));
    for (int i = 0; i <= steps; ++i) {
      const Eigen::Vector3d at = from + (to - from) * i / steps;
      columns_[columnOf(at)] &= ~voxelOf(std::max(at.z(), origin_z_));
    }
  }
  void mark(const Eigen::Vector3d& /*from*/, const Eigen::Vector3d& at) {
    columns_[columnOf(at)] |= voxelOf(std::max(at.z(), origin_z_));
  }

  tf2_ros::Buffer& buffer_;
  std::string global_frame_;
  double voxel_height_ = 0.0, origin_z_ = 0.0;  ///< [m]
  int voxels_ = 0;
  std::vector<Source> sources_;
  std::map<Column, std::uint32_t> columns_;  ///< marked voxels of those that were looked at
};

}  // namespace dominant_plane_detection
