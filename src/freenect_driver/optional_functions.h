#pragma once

#include <libfreenect.h>
#include <libfreenect_registration.h>

namespace dominant_plane_detection::freenect_driver {

/// Functions that not every libfreenect has; fakenect, which plays recordings, lacks them all. Each
/// is null where it is missing. Everything else of libfreenect is called as it is.
struct OptionalFunctions {
  decltype(&::freenect_list_device_attributes) list_device_attributes = nullptr;
  decltype(&::freenect_free_device_attributes) free_device_attributes = nullptr;
  decltype(&::freenect_enabled_subdevices) enabled_subdevices = nullptr;
  decltype(&::freenect_set_flag) set_flag = nullptr;
  /// Of later versions than 0.5.3, whose header does not have it either.
  int (*set_exposure)(freenect_device*, int microseconds) = nullptr;
  decltype(&::freenect_copy_registration) copy_registration = nullptr;
  decltype(&::freenect_destroy_registration) destroy_registration = nullptr;
};

/// @return those of the libfreenect that is loaded.
const OptionalFunctions& optionalFunctions();

}  // namespace dominant_plane_detection::freenect_driver
