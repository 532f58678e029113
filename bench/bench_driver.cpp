// The whole way in one manager at 30 Hz: the share of a core that driver and detection take, and
// the time from the camera driver's frame to the published plane. Needs a master.

#include <dirent.h>
#include <dominant_plane_detection/DominantPlane.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <vector>

#include "support/driver_test.h"
#include "support/scoring.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kUri = "virtual://rubbish_bin?serial=BENCH";
constexpr double kSeconds = 20.0;
constexpr double kHalfPeriod = 1.0 / 60.0;  // [s]

std::int64_t steadyNanoseconds() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// @return [s] of processor time that the threads which render have taken.
double renderingTime() {
  double seconds = 0.0;
  DIR* folder = opendir("/proc/self/task");
  while (const dirent* entry = readdir(folder)) {
    std::ifstream stat(std::string("/proc/self/task/") + entry->d_name + "/stat");
    std::string text;
    if (!std::getline(stat, text) || text.find("(virtual_kinect)") == std::string::npos) continue;
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string skipped;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    double user = 0.0, system = 0.0;
    fields >> user >> system;
    seconds += (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  closedir(folder);
  return seconds;
}

/// @return [s] of processor time that this process has taken apart from that.
double ownTime() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime) - renderingTime();
}

struct Arrival {
  double stamp;          ///< [s]
  std::int64_t arrived;  ///< [ns] of the steady clock
};

void wait(double seconds) { ros::WallDuration(seconds).sleep(); }

void run() {
  ros::NodeHandle node("/camera");
  ros::AsyncSpinner spinner(1);
  spinner.start();
  std::mutex mutex;
  std::vector<Arrival> arrivals;
  const ros::Subscriber planes =
      node.subscribe<DominantPlane>("plane_detection/plane", 10, [&](const auto& plane) {
        const std::lock_guard<std::mutex> lock(mutex);
        arrivals.push_back({plane->header.stamp.toSec(), steadyNanoseconds()});
      });
  int others = 0;
  const ros::Subscriber masks = node.subscribe<sensor_msgs::Image>(
      "plane_detection/ground_mask", 1, [&](const sensor_msgs::ImageConstPtr&) { ++others; });
  const ros::Subscriber obstacles = node.subscribe<sensor_msgs::PointCloud2>(
      "plane_detection/obstacles", 1, [&](const sensor_msgs::PointCloud2ConstPtr&) { ++others; });
  Manager manager;
  if (!manager.loadDriver("/camera", kUri) || !manager.loadDetection("/camera")) return;
  wait(2.0);

  std::map<std::uint64_t, virtual_kinect::FrameRecord> records;
  const double before = ownTime();
  const std::int64_t begin = steadyNanoseconds();
  for (double passed = 0.0; passed < kSeconds; passed += 2.0) {
    wait(2.0);
    for (const auto& record : Probe(kUri).records()) records[record.timestamp] = record;
  }
  const double share =
      (ownTime() - before) / (1e-9 * static_cast<double>(steadyNanoseconds() - begin));
  manager.unload("/camera/plane_detection");
  manager.unload("/camera/driver");

  std::vector<double> latencies;
  for (const Arrival& arrival : arrivals) {
    for (const auto& [timestamp, record] : records) {
      if (std::abs(1e-9 * static_cast<double>(record.exposed) - arrival.stamp) > kHalfPeriod)
        continue;
      latencies.push_back(1e-6 * static_cast<double>(arrival.arrived - record.raised));
      break;
    }
  }
  std::printf("| at 30 Hz with plane, mask and obstacles | |\n|---|---|\n");
  std::printf("| share of a core, driver and detection (rendering apart) | %.1f %% |\n",
              100.0 * share);
  std::printf("| frame to plane, median | %.2f ms |\n", quantile(latencies, 0.5));
  std::printf("| frame to plane, 99 %% | %.2f ms |\n", quantile(latencies, 0.99));
  std::printf("| planes compared, masks and clouds received | %zu, %d |\n", latencies.size(),
              others);
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  ros::init(argc, argv, "bench_driver", ros::init_options::AnonymousName);
  dominant_plane_detection::run();
}
