#pragma once

#include <cstring>

#include "virtual_kinect/openni2_driver_api.h"

namespace dominant_plane_detection::virtual_kinect {

/// Copies a property to whoever asks for it. @return ONI_STATUS_BAD_PARAMETER for another size.
template <typename T>
OniStatus giveProperty(const T& value, void* data, int* size) {
  if (*size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof(T));
  return ONI_STATUS_OK;
}

/// Takes a property. @return ONI_STATUS_BAD_PARAMETER for another size.
template <typename T>
OniStatus takeProperty(T& value, const void* data, int size) {
  if (size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(&value, data, sizeof(T));
  return ONI_STATUS_OK;
}

}  // namespace dominant_plane_detection::virtual_kinect
