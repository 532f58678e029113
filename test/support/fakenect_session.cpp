#include "support/fakenect_session.h"

#include <libfreenect.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace dominant_plane_detection {
namespace {

constexpr double kTicks = 60e6;  // [1/s] of a Kinect's clock

}  // namespace

FakenectSession::FakenectSession(const std::string& name)
    : folder_(std::filesystem::temp_directory_path() /
              ("dpd_" + name + "_" + std::to_string(getpid()))) {
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
  index_.open(folder_ / "INDEX.txt");
}

FakenectSession::~FakenectSession() {
  std::error_code error;
  std::filesystem::remove_all(folder_, error);
}

void FakenectSession::addDepth(double time, const cv::Mat& raw) {
  write('d', time, "P5 640 480 65535\n", raw.data, raw.total() * raw.elemSize(), "pgm");
}

void FakenectSession::addColour(double time, const cv::Mat& rgb) {
  write('r', time, "P6 640 480 255\n", rgb.data, rgb.total() * rgb.elemSize(), "ppm");
}

void FakenectSession::addAcceleration(double time, const Eigen::Vector3d& felt) {
  const auto counts = [](double acceleration) {
    return static_cast<std::int16_t>(std::lround(acceleration / 9.80665 * FREENECT_COUNTS_PER_G));
  };
  freenect_raw_tilt_state state{};
  state.accelerometer_x = counts(felt.x());
  state.accelerometer_y = counts(felt.y());
  state.accelerometer_z = counts(felt.z());
  write('a', time, "", &state, sizeof(state), "dump");
}

void FakenectSession::repeat(double period, int times) {
  for (int k = 1; k <= times; ++k) {
    for (const Entry& entry : entries_) {
      const std::string copy = nameOf({entry.kind, entry.time + k * period, entry.ending});
      std::filesystem::create_hard_link(folder_ / nameOf(entry), folder_ / copy);
      list(copy);
    }
  }
}

std::string FakenectSession::nameOf(const Entry& entry) {
  char name[64];
  const auto ticks = static_cast<std::uint32_t>(static_cast<std::uint64_t>(entry.time * kTicks));
  std::snprintf(name, sizeof(name), "%c-%f-%u.%s", entry.kind, entry.time, ticks,
                entry.ending.c_str());
  return name;
}

void FakenectSession::write(char kind, double time, const std::string& header, const void* data,
                            std::size_t bytes, const std::string& ending) {
  entries_.push_back({kind, time, ending});
  const std::string name = nameOf(entries_.back());
  std::ofstream file(folder_ / name, std::ios::binary);
  file << header;
  file.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
  list(name);
}

}  // namespace dominant_plane_detection
