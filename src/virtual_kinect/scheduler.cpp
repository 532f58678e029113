#include "virtual_kinect/scheduler.h"

namespace dominant_plane_detection::virtual_kinect {

Scheduler::Scheduler() : thread_([this] { run(); }) {}

Scheduler::~Scheduler() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Scheduler::after(double delay, std::function<void()> function) {
  const auto time = Steady::now() + std::chrono::duration_cast<Steady::duration>(
                                        std::chrono::duration<double>(delay));
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.emplace(time, std::move(function));
  changed_.notify_all();
}

void Scheduler::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ending_) {
    if (waiting_.empty()) {
      changed_.wait(lock);
    } else if (waiting_.begin()->first > Steady::now()) {
      const auto until = waiting_.begin()->first;
      changed_.wait_until(lock, until);
    } else {
      const std::function<void()> function = std::move(waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
      lock.unlock();
      function();
      lock.lock();
    }
  }
}

}  // namespace dominant_plane_detection::virtual_kinect
