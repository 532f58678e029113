#include "ros/camera_info_matcher.h"

#include <algorithm>

#include "ros/camera_conversion.h"

namespace dominant_plane_detection {
namespace {

/// Enough that neither is lost when one topic runs a few messages ahead of the other.
constexpr std::size_t kKept = 8;
constexpr double kPatience = 1.0;  // [s]

template <typename Queue>
auto findStamp(const Queue& queue, const ros::Time& stamp) {
  return std::find_if(queue.begin(), queue.end(),
                      [&](const auto& message) { return message->header.stamp == stamp; });
}

template <typename Queue, typename Message>
void keep(Queue& queue, const Message& message) {
  queue.push_back(message);
  if (queue.size() > kKept) queue.pop_front();
}

}  // namespace

std::optional<CameraInfoMatcher::Pair> CameraInfoMatcher::addImage(
    const sensor_msgs::ImageConstPtr& image, double now) {
  const auto info = findStamp(infos_, image->header.stamp);
  if (info != infos_.end()) return matched({image, *info, true}, now);
  if (!last_match_) last_match_ = now;
  if (now - *last_match_ < kPatience) {
    keep(images_, image);
    return std::nullopt;
  }
  const auto latest = std::find_if(infos_.rbegin(), infos_.rend(), [&](const auto& candidate) {
    const ImageSize size = imageSize(*candidate);
    return candidate->header.frame_id == image->header.frame_id && size.width == image->width &&
           size.height == image->height;
  });
  if (latest == infos_.rend()) {
    keep(images_, image);  // its own may still come
    return std::nullopt;
  }
  images_.clear();
  return Pair{image, *latest, false};
}

std::optional<CameraInfoMatcher::Pair> CameraInfoMatcher::addInfo(
    const sensor_msgs::CameraInfoConstPtr& info, double now) {
  keep(infos_, info);
  const auto image = findStamp(images_, info->header.stamp);
  if (image == images_.end()) return std::nullopt;
  return matched({*image, info, true}, now);
}

/// Images that have waited longer than this one are older: they will not be shown any more.
std::optional<CameraInfoMatcher::Pair> CameraInfoMatcher::matched(const Pair& pair, double now) {
  last_match_ = now;
  const auto image = findStamp(images_, pair.image->header.stamp);
  if (image != images_.end()) images_.erase(images_.begin(), std::next(image));
  return pair;
}

}  // namespace dominant_plane_detection
