#include "openni2/lasting_threads.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace dominant_plane_detection {
namespace {

class LastingThreads {
 public:
  std::future<void> run(std::function<void()> function) {
    std::packaged_task<void()> task(std::move(function));
    std::future<void> done = task.get_future();
    const std::lock_guard<std::mutex> lock(mutex_);
    tasks_.push_back(std::move(task));
    if (tasks_.size() > idle_) std::thread([this] { work(); }).detach();
    changed_.notify_one();
    return done;
  }

 private:
  void work() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      ++idle_;
      changed_.wait(lock, [this] { return !tasks_.empty(); });
      --idle_;
      std::packaged_task<void()> task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
      task = {};  // what the function holds may need the lock to go
      lock.lock();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::packaged_task<void()>> tasks_;
  std::size_t idle_ = 0;
};

}  // namespace

std::future<void> runInLastingThread(std::function<void()> function) {
  static auto& threads = *new LastingThreads;  // never destroyed: its threads never end
  return threads.run(std::move(function));
}

}  // namespace dominant_plane_detection
