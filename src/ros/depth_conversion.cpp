#include "ros/depth_conversion.h"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>

#include "ros/byte_order.h"

namespace dominant_plane_detection {
namespace {

namespace encodings = sensor_msgs::image_encodings;

std::optional<DepthView::Type> depthType(const std::string& encoding) {
  if (encoding == encodings::TYPE_16UC1 || encoding == encodings::MONO16) {
    return DepthView::Type::kUint16;
  }
  if (encoding == encodings::TYPE_32FC1) return DepthView::Type::kFloat32;
  return std::nullopt;
}

}  // namespace

void describe(const sensor_msgs::Image& image, InputFacts& facts) {
  facts.frame_id = image.header.frame_id;
  facts.encoding = image.encoding;
  facts.encoding_is_depth = depthType(image.encoding).has_value();
  facts.width = static_cast<int>(image.width);
  facts.height = static_cast<int>(image.height);
}

std::optional<DepthView> DepthReader::read(const sensor_msgs::Image& image, std::string& error) {
  const auto type = depthType(image.encoding);
  if (!type) {
    error = "expected a depth image of encoding 16UC1 or 32FC1, got '" + image.encoding + "'";
    return std::nullopt;
  }
  const std::size_t pixel_size = pixelSize(*type);
  constexpr std::uint32_t kMaxSide = 1U << 15U;  // keeps every index an int
  if (image.width == 0 || image.height == 0 || image.width > kMaxSide || image.height > kMaxSide) {
    error = "expected a depth image of 1 to 32768 pixels each way, got " +
            std::to_string(image.width) + " x " + std::to_string(image.height);
    return std::nullopt;
  }
  if (image.step < image.width * pixel_size || image.step % pixel_size != 0) {
    error = "expected a step of at least " + std::to_string(image.width * pixel_size) +
            " bytes that is a multiple of " + std::to_string(pixel_size) + ", got " +
            std::to_string(image.step);
    return std::nullopt;
  }
  // The last row need not be padded.
  const std::size_t needed =
      static_cast<std::size_t>(image.step) * (image.height - 1) + image.width * pixel_size;
  if (image.data.size() < needed) {
    error = "expected at least " + std::to_string(needed) + " bytes of depth data, got " +
            std::to_string(image.data.size());
    return std::nullopt;
  }
  DepthView view;
  view.data = image.data.data();
  view.width = static_cast<int>(image.width);
  view.height = static_cast<int>(image.height);
  view.step = image.step;
  view.type = *type;
  if ((image.is_bigendian != 0) != machineIsBigEndian()) {
    swapped_.assign(image.data.begin(), image.data.end());
    const std::size_t whole = swapped_.size() - swapped_.size() % pixel_size;
    for (std::size_t i = 0; i < whole; i += pixel_size) {
      const auto pixel = swapped_.begin() + static_cast<std::ptrdiff_t>(i);
      std::reverse(pixel, pixel + static_cast<std::ptrdiff_t>(pixel_size));
    }
    view.data = swapped_.data();
  }
  return view;
}

}  // namespace dominant_plane_detection
