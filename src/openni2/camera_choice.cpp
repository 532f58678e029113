#include "openni2/camera_choice.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace dominant_plane_detection {
namespace {

std::string list(const std::vector<CameraDescription>& cameras) {
  if (cameras.empty()) return "no camera is connected";
  std::string text = "connected: ";
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    text += (i == 0 ? "#" : ", #") + std::to_string(i + 1) + " " + describe(cameras[i]);
  }
  return text;
}

bool isFile(const std::string& id) {
  return id.size() > 4 && id.compare(id.size() - 4, 4, ".oni") == 0;
}

CameraChoice byNumber(const std::string& id, const std::vector<CameraDescription>& cameras) {
  std::size_t number = 0;
  const char* end = id.data() + id.size();
  const auto [stop, error] = std::from_chars(id.data() + 1, end, number);
  if (error != std::errc() || stop != end || number == 0) {
    return {"", "expected # and a number from 1, got '" + id + "'; " + list(cameras)};
  }
  if (number > cameras.size()) return {"", "there is no camera " + id + "; " + list(cameras)};
  return {cameras[number - 1].uri, ""};
}

}  // namespace

bool namesItself(const std::string& id) { return id.rfind("virtual://", 0) == 0 || isFile(id); }

CameraChoice chooseCamera(const std::string& id, const std::vector<CameraDescription>& cameras) {
  if (isFile(id)) {
    std::error_code error;
    if (!std::filesystem::exists(id, error)) return {"", "there is no file " + id};
    return {std::filesystem::absolute(id).string(), ""};
  }
  if (namesItself(id)) return {id, ""};
  if (id.empty()) return {"", "expected a device_id, got an empty one; " + list(cameras)};
  if (id[0] == '#') return byNumber(id, cameras);

  const auto matching = [&](auto matches) {
    std::vector<CameraDescription> found;
    std::copy_if(cameras.begin(), cameras.end(), std::back_inserter(found), matches);
    return found;
  };
  auto found = matching(
      [&](const CameraDescription& camera) { return camera.uri == id || camera.serial == id; });
  if (found.empty()) {
    found = matching(
        [&](const CameraDescription& camera) { return camera.uri.find(id) != std::string::npos; });
  }
  if (found.size() == 1) return {found.front().uri, ""};
  if (found.empty()) return {"", "no camera fits '" + id + "'; " + list(cameras)};
  return {"", "'" + id + "' fits " + std::to_string(found.size()) + " cameras; " + list(cameras)};
}

}  // namespace dominant_plane_detection
