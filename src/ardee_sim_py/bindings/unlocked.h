// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

namespace ardee::python {

/// Lets other threads of Python run while it lives. Python ends a thread that comes back from C++
/// after the program's end, such as a daemon's, in a way that no C++ survives: so the end waits for
/// those that are away, and lets none go any more.
class Unlocked {
 public:
  Unlocked() {
    if (ends_) return;
    ++away_;
    free_.emplace();
  }
  ~Unlocked() {
    if (!free_) return;
    free_.reset();
    --away_;
  }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

  /// Whether the program ends, and this thread is not the one that ends it.
  static bool has_to_return() { return ends_ && std::this_thread::get_id() != ender_; }
  /// Waits until all threads are back.
  static void end() {
    ender_ = std::this_thread::get_id();
    ends_ = true;
    const pybind11::gil_scoped_release free;
    while (away_ > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

 private:
  inline static std::atomic<int> away_{0};
  inline static std::atomic<bool> ends_{false};
  inline static std::thread::id ender_;
  std::optional<pybind11::gil_scoped_release> free_;
};

}  // namespace ardee::python
