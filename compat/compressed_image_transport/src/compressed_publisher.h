// SPDX-License-Identifier: MIT
#pragma once

#include <compressed_image_transport/CompressedPublisherConfig.h>
#include <dynamic_reconfigure/server.h>
#include <image_transport/simple_publisher_plugin.h>
#include <sensor_msgs/CompressedImage.h>

#include <memory>
#include <mutex>

#include "codec.h"

namespace compressed_image_transport {

/// Offers `<base topic>/compressed` beside each image topic. Images are compressed in the thread
/// that publishes them, and only while somebody subscribes.
class CompressedPublisher
    : public image_transport::SimplePublisherPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressed"; }

 protected:
  void advertiseImpl(ros::NodeHandle& node, const std::string& base_topic, std::uint32_t queue_size,
                     const image_transport::SubscriberStatusCallback& on_connect,
                     const image_transport::SubscriberStatusCallback& on_disconnect,
                     const ros::VoidPtr& tracked_object, bool latch) override;
  void publish(const sensor_msgs::Image& image, const PublishFn& publish_fn) const override;

 private:
  using Config = CompressedPublisherConfig;

  Options options() const;
  void complain(const std::string& what) const;

  mutable std::mutex mutex_;  // parameters come in another thread than images
  Options options_;
  mutable std::string complaint_;  // what was said last
  std::unique_ptr<dynamic_reconfigure::Server<Config>> server_;
};

}  // namespace compressed_image_transport
