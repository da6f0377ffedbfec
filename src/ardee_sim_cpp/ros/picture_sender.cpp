// SPDX-License-Identifier: MIT
#include "ros/picture_sender.h"

namespace ardee::node {

PictureSender::PictureSender(const image_transport::Publisher& publisher, std::size_t most_waiting)
    : publisher_(publisher), most_waiting_(most_waiting) {}

PictureSender::~PictureSender() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void PictureSender::send(const sensor_msgs::ImageConstPtr& picture) {
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.size() >= most_waiting_) waiting_.pop_front();
    waiting_.push_back(picture);
  }
  changed_.notify_one();
}

void PictureSender::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
    if (is_ending_) return;
    const sensor_msgs::ImageConstPtr picture = waiting_.front();
    waiting_.pop_front();
    lock.unlock();
    publisher_.publish(picture);
    lock.lock();
  }
}

}  // namespace ardee::node
