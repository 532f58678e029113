#include "ros/detection_messages.h"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <boost/make_shared.hpp>

namespace dominant_plane_detection {

DominantPlanePtr planeMessage(const std_msgs::Header& header, const Detection& detection,
                              double processing_time) {
  auto message = boost::make_shared<DominantPlane>();
  message->header = header;
  message->state = static_cast<std::uint8_t>(detection.state);
  message->reason = detection.reason;
  message->normal.x = detection.normal.x();
  message->normal.y = detection.normal.y();
  message->normal.z = detection.normal.z();
  message->distance = detection.distance;
  // Symmetric, so Eigen's column-major order is the message's row-major one.
  std::copy_n(detection.covariance.data(), message->covariance.size(), message->covariance.begin());
  message->mean_square_error = detection.mean_square_error;
  message->inliers = static_cast<std::uint32_t>(detection.inliers);
  message->inlier_share = static_cast<float>(detection.inlierShare());
  message->up_source = static_cast<std::uint8_t>(detection.up_source);
  message->tracked = false;
  message->processing_time = static_cast<float>(processing_time);
  return message;
}

pcl_msgs::ModelCoefficientsPtr coefficientsMessage(const std_msgs::Header& header,
                                                   const Detection& detection) {
  auto message = boost::make_shared<pcl_msgs::ModelCoefficients>();
  message->header = header;
  for (int i = 0; i < 3; ++i) message->values.push_back(static_cast<float>(detection.normal[i]));
  message->values.push_back(static_cast<float>(detection.distance));
  return message;
}

sensor_msgs::ImagePtr maskMessage(const std_msgs::Header& header, const Detection& detection) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->encoding = sensor_msgs::image_encodings::MONO8;
  message->width = static_cast<std::uint32_t>(detection.width);
  message->height = static_cast<std::uint32_t>(detection.height);
  message->step = message->width;
  message->data.resize(detection.labels.size());
  constexpr auto kGround = static_cast<std::uint8_t>(Label::kGround);
  std::transform(detection.labels.begin(), detection.labels.end(), message->data.begin(),
                 [](std::uint8_t label) { return label == kGround ? 255 : 0; });
  return message;
}

}  // namespace dominant_plane_detection
