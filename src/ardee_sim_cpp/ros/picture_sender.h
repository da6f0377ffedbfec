// SPDX-License-Identifier: MIT
#pragma once

#include <image_transport/publisher.h>
#include <sensor_msgs/Image.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <thread>

namespace ardee::node {

/// Publishes one camera's pictures from a separate thread: a plugin of image_transport that
/// compresses them would delay the simulation. If pictures arrive faster than they leave, the
/// oldest is dropped, as in a publisher's own queue.
class PictureSender {
 public:
  PictureSender(const image_transport::Publisher& publisher, std::size_t most_waiting);
  ~PictureSender();
  PictureSender(const PictureSender&) = delete;
  PictureSender& operator=(const PictureSender&) = delete;

  /// Whether there are subscribers, to raw or compressed pictures.
  bool has_listeners() const { return publisher_.getNumSubscribers() > 0; }
  void send(const sensor_msgs::ImageConstPtr& picture);

 private:
  void run();

  const image_transport::Publisher publisher_;
  const std::size_t most_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<sensor_msgs::ImageConstPtr> waiting_;
  bool is_ending_ = false;
  std::thread thread_;  // from the first picture on
};

}  // namespace ardee::node
