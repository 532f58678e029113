#include "bag_topics.h"

#include <rosbag/view.h>
#include <sensor_msgs/Image.h>

namespace dominant_plane_detection {

std::set<std::string> depthTopics(const rosbag::Bag& bag) {
  rosbag::View images(bag, rosbag::TypeQuery("sensor_msgs/Image"));
  std::set<std::string> seen, depth;
  const std::size_t topics = images.getConnections().size();
  for (const rosbag::MessageInstance& message : images) {
    if (!seen.insert(message.getTopic()).second) continue;
    const auto image = message.instantiate<sensor_msgs::Image>();
    const std::string& encoding = image->encoding;
    if (encoding == "16UC1" || encoding == "32FC1") depth.insert(message.getTopic());
    if (seen.size() == topics) break;
  }
  return depth;
}

std::map<std::string, std::string> topicTypes(const rosbag::Bag& bag) {
  rosbag::View all(bag);
  std::map<std::string, std::string> types;
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    types[connection->topic] = connection->datatype;
  }
  return types;
}

std::map<ros::Time, sensor_msgs::CameraInfoConstPtr> cameraInfos(const rosbag::Bag& bag,
                                                                 const std::string& topic) {
  std::map<ros::Time, sensor_msgs::CameraInfoConstPtr> infos;
  rosbag::View messages(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& message : messages) {
    const auto info = message.instantiate<sensor_msgs::CameraInfo>();
    if (info) infos[info->header.stamp] = info;
  }
  return infos;
}

}  // namespace dominant_plane_detection
