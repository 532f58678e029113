#include "ros/driver_diagnostics.h"

#include <diagnostic_msgs/DiagnosticStatus.h>

namespace dominant_plane_detection {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kSlow = 0.8;      // [-] share of the mode's rate below which to warn
constexpr double kShortest = 0.5;  // [s] of which a rate can be told
constexpr double kPeriod = 1.0;    // [s] between reports

const char* nameOf(SessionState state) {
  switch (state) {
    case SessionState::kSearching:
      return "searching";
    case SessionState::kIdle:
      return "idle";
    case SessionState::kStreaming:
      return "streaming";
    case SessionState::kSilent:
      return "silent";
    default:
      return "finished";
  }
}

}  // namespace

DriverDiagnostics::DriverDiagnostics(const ros::NodeHandle& node,
                                     const ros::NodeHandle& private_node, const std::string& name,
                                     std::function<SessionStatus()> status)
    : status_(std::move(status)), updater_(node, private_node, name) {
  updater_.setHardwareID("none");
  updater_.add("camera", [this](auto& report) { reportCamera(report); });
  for (const StreamKind kind : kAllStreams) {
    updater_.add(toString(kind), [this, kind](auto& report) { reportStream(kind, report); });
  }
  timer_ = node.createWallTimer(ros::WallDuration(kPeriod), [this](const ros::WallTimerEvent&) {
    const std::string serial = status_().camera.serial;
    updater_.setHardwareID(serial.empty() ? "none" : serial);
    updater_.force_update();
  });
}

void DriverDiagnostics::setWanted(StreamKind kind, bool wanted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Stream& stream = streams_[static_cast<int>(kind)];
  if (stream.wanted == wanted) return;
  stream.wanted = wanted;
  stream.since = ros::SteadyTime::now();
  stream.reported = stream.frames;
  stream.last_number = -1;
}

void DriverDiagnostics::beginNumbers() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Stream& stream : streams_) stream.last_number = -1;
}

void DriverDiagnostics::count(StreamKind kind, const SensorFrame& frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Stream& stream = streams_[static_cast<int>(kind)];
  const int missing = frame.number - stream.last_number - 1;
  // A number that goes back is that of a stream or a recording that began again.
  if (stream.last_number >= 0 && missing > 0) stream.dropped += static_cast<std::uint64_t>(missing);
  stream.last_number = frame.number;
  stream.rate = frame.rate;
  ++stream.frames;
}

void DriverDiagnostics::reportCamera(diagnostic_updater::DiagnosticStatusWrapper& report) {
  const SessionStatus status = status_();
  const bool well =
      status.state != SessionState::kSearching && status.state != SessionState::kSilent;
  report.summary(well ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                 std::string(nameOf(status.state)) + ": " + status.text);
  report.add("state", nameOf(status.state));
  report.add("uri", status.camera.uri);
  report.add("name", status.camera.vendor + " " + status.camera.name);
  report.add("serial number", status.camera.serial);
  report.add("times opened", status.connections);
  report.add("silent streams started anew", status.restarts);
}

void DriverDiagnostics::reportStream(StreamKind kind,
                                     diagnostic_updater::DiagnosticStatusWrapper& report) {
  const bool streaming = status_().state == SessionState::kStreaming;
  const std::lock_guard<std::mutex> lock(mutex_);
  Stream& stream = streams_[static_cast<int>(kind)];
  const ros::SteadyTime now = ros::SteadyTime::now();
  const double seconds = (now - stream.since).toSec();
  if (!stream.wanted) {
    report.summary(DiagnosticStatus::OK, "idle: nobody listens");
  } else if (seconds < kShortest) {
    report.summary(DiagnosticStatus::OK, "starting");
  } else {
    const double rate = static_cast<double>(stream.frames - stream.reported) / seconds;
    const bool slow = streaming && rate < kSlow * stream.rate;
    report.summaryf(slow ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                    "%.1f images a second, %d by the mode", rate, stream.rate);
    report.addf("rate [1/s]", "%.2f", rate);
    stream.since = now;
    stream.reported = stream.frames;
  }
  report.add("rate of the mode [1/s]", stream.rate);
  report.add("images", stream.frames);
  report.add("dropped images", stream.dropped);
}

}  // namespace dominant_plane_detection
