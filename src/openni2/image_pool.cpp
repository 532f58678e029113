#include "openni2/image_pool.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <vector>

namespace dominant_plane_detection {

struct ImagePool::State {
  struct Loan {
    std::unique_ptr<sensor_msgs::Image> image;
    bool by_driver = true;
    bool by_subscribers = false;
    std::size_t bytes = 0;  ///< that it had when it was taken
  };

  std::mutex mutex;
  std::size_t most_spare;
  std::size_t taken_bytes = 0;        ///< of the loans by subscribers
  std::map<const void*, Loan> loans;  ///< by the first byte
  std::vector<std::unique_ptr<sensor_msgs::Image>> spare;

  void end(const void* memory, bool Loan::*holder) {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto loan = loans.find(memory);
    if (loan == loans.end()) return;
    if (holder == &Loan::by_subscribers) taken_bytes -= loan->second.bytes;
    loan->second.*holder = false;
    if (loan->second.by_driver || loan->second.by_subscribers) return;
    if (spare.size() < most_spare) spare.push_back(std::move(loan->second.image));
    loans.erase(loan);
  }
};

ImagePool::ImagePool(std::size_t spare) : state_(std::make_shared<State>()) {
  state_->most_spare = spare;
}

void* ImagePool::lend(std::size_t bytes) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  std::unique_ptr<sensor_msgs::Image> image;
  if (state_->spare.empty()) {
    image = std::make_unique<sensor_msgs::Image>();
  } else {
    image = std::move(state_->spare.back());
    state_->spare.pop_back();
  }
  image->data.resize(bytes);
  void* memory = image->data.data();
  state_->loans[memory].image = std::move(image);
  return memory;
}

sensor_msgs::ImagePtr ImagePool::take(const void* memory) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  const auto loan = state_->loans.find(memory);
  if (loan == state_->loans.end() || loan->second.by_subscribers) return nullptr;
  loan->second.by_subscribers = true;
  loan->second.bytes = loan->second.image->data.size();
  state_->taken_bytes += loan->second.bytes;
  return {loan->second.image.get(), [state = state_, memory](sensor_msgs::Image*) {
            state->end(memory, &State::Loan::by_subscribers);
          }};
}

sensor_msgs::ImagePtr ImagePool::make(std::size_t bytes) {
  void* const memory = lend(bytes);
  sensor_msgs::ImagePtr image = take(memory);
  giveBack(memory);
  return image;
}

void ImagePool::giveBack(const void* memory) { state_->end(memory, &State::Loan::by_driver); }

bool ImagePool::lent() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return std::any_of(state_->loans.begin(), state_->loans.end(),
                     [](const auto& loan) { return loan.second.by_driver; });
}

std::size_t ImagePool::takenBytes() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->taken_bytes;
}

std::size_t ImagePool::messages() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->loans.size() + state_->spare.size();
}

}  // namespace dominant_plane_detection
