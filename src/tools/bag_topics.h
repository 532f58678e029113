#pragma once

#include <ros/time.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>

#include <map>
#include <set>
#include <string>

namespace dominant_plane_detection {

/// @return the topics whose images can be depth.
std::set<std::string> depthTopics(const rosbag::Bag& bag);

/// @return the type of each topic.
std::map<std::string, std::string> topicTypes(const rosbag::Bag& bag);

/// @return the camera_info on a topic, by their stamps; messages of another type are left out.
std::map<ros::Time, sensor_msgs::CameraInfoConstPtr> cameraInfos(const rosbag::Bag& bag,
                                                                 const std::string& topic);

}  // namespace dominant_plane_detection
