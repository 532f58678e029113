#pragma once

#include <ros/callback_queue_interface.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <functional>
#include <utility>

namespace dominant_plane_detection {

/// Calls a function in the thread of a callback queue, behind what waits there already. From any
/// thread; never waits.
/// @param owner whoever takes the call back, by `removeCalls`, before `function` may not be called
/// any more.
inline void callLater(ros::CallbackQueueInterface& queue, const void* owner,
                      std::function<void()> function) {
  struct Call : ros::CallbackInterface {
    explicit Call(std::function<void()> f) : function(std::move(f)) {}
    CallResult call() override {
      function();
      return Success;
    }
    std::function<void()> function;
  };
  queue.addCallback(boost::make_shared<Call>(std::move(function)),
                    reinterpret_cast<std::uint64_t>(owner));
}

/// Takes back what an owner has asked for; waits for one of its calls that runs in another thread.
inline void removeCalls(ros::CallbackQueueInterface& queue, const void* owner) {
  queue.removeByID(reinterpret_cast<std::uint64_t>(owner));
}

}  // namespace dominant_plane_detection
