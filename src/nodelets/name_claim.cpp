#include "nodelets/name_claim.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <stdexcept>

namespace dominant_plane_detection {
namespace {

constexpr std::chrono::seconds kPatience{10};

struct Claims {
  std::mutex mutex;
  std::condition_variable changed;
  std::set<std::string> names;
};

/// Never destroyed: nodelets may be when the process ends.
Claims& claims() {
  static auto* const all = new Claims;
  return *all;
}

}  // namespace

NameClaim::NameClaim(const std::string& name) : name_(name) {
  Claims& all = claims();
  std::unique_lock<std::mutex> lock(all.mutex);
  if (!all.changed.wait_for(lock, kPatience, [&] { return all.names.count(name) == 0; })) {
    throw std::runtime_error("expected " + name + " to be unloaded, but it is still running");
  }
  all.names.insert(name);
}

NameClaim::~NameClaim() {
  Claims& all = claims();
  {
    const std::lock_guard<std::mutex> lock(all.mutex);
    all.names.erase(name_);
  }
  all.changed.notify_all();
}

}  // namespace dominant_plane_detection
