#pragma once

#include <functional>

namespace dominant_plane_detection {

/// @return what publishers call, those of messages and of image_transport, when somebody begins or
/// ends to listen.
inline auto calledByPublishers(const std::function<void()>& listeners_changed) {
  return [listeners_changed](const auto& /*publisher*/) { listeners_changed(); };
}

}  // namespace dominant_plane_detection
