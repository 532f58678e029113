#pragma once

#include <string>
#include <vector>

#include "openni2/runtime.h"

namespace dominant_plane_detection {

/// What a `device_id` stands for.
struct CameraChoice {
  std::string uri;    ///< empty when nothing was chosen
  std::string error;  ///< then: why, and which cameras there are
};

/// @return whether an id names what to open itself, an .oni file or a virtual device, so that it
/// need not be in any list.
bool namesItself(const std::string& id);

/// @param id `#1` (the first camera of the list), a serial number, a URI or a part of one, an .oni
/// file or `virtual://...`; a serial number or a part of a URI has to fit one camera only.
CameraChoice chooseCamera(const std::string& id, const std::vector<CameraDescription>& cameras);

}  // namespace dominant_plane_detection
