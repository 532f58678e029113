#pragma once

#include <cstring>
#include <string>

#include "openni2_plugin/driver_api.h"

namespace dominant_plane_detection::openni2_plugin {

/// Copies a property to whoever asks for it. @return ONI_STATUS_BAD_PARAMETER for another size.
template <typename T>
OniStatus giveProperty(const T& value, void* data, int* size) {
  if (*size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof(T));
  return ONI_STATUS_OK;
}

/// The same for a text, with its final 0. @return ONI_STATUS_BAD_PARAMETER for too little room.
inline OniStatus giveText(const std::string& text, void* data, int* size) {
  const int needed = static_cast<int>(text.size()) + 1;
  if (*size < needed) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, text.c_str(), static_cast<std::size_t>(needed));
  *size = needed;
  return ONI_STATUS_OK;
}

/// Takes a property. @return ONI_STATUS_BAD_PARAMETER for another size.
template <typename T>
OniStatus takeProperty(T& value, const void* data, int size) {
  if (size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(&value, data, sizeof(T));
  return ONI_STATUS_OK;
}

}  // namespace dominant_plane_detection::openni2_plugin
