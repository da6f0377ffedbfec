// SPDX-License-Identifier: MIT
#include "compressed_publisher.h"

#include <ros/console.h>
#include <ros/service_manager.h>

namespace compressed_image_transport {

void CompressedPublisher::advertiseImpl(
    ros::NodeHandle& node, const std::string& base_topic, std::uint32_t queue_size,
    const image_transport::SubscriberStatusCallback& on_connect,
    const image_transport::SubscriberStatusCallback& on_disconnect,
    const ros::VoidPtr& tracked_object, bool latch) {
  SimplePublisherPlugin::advertiseImpl(node, base_topic, queue_size, on_connect, on_disconnect,
                                       tracked_object, latch);
  // Of two publishers of one topic in a node the first has the parameters.
  if (ros::ServiceManager::instance()->lookupServicePublication(nh().resolveName("set_parameters")))
    return;
  server_ = std::make_unique<dynamic_reconfigure::Server<Config>>(nh());
  server_->setCallback([this](const Config& config, std::uint32_t) {
    const std::lock_guard<std::mutex> lock(mutex_);
    options_ = {config.format, config.jpeg_quality, config.png_level};
  });
}

Options CompressedPublisher::options() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return options_;
}

/// Once: a camera does not change its encoding, and publishes many times a second.
void CompressedPublisher::complain(const std::string& what) const {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (complaint_ == what) return;
    complaint_ = what;
  }
  ROS_ERROR_STREAM(getTopic() << ": " << what);
}

void CompressedPublisher::publish(const sensor_msgs::Image& image,
                                  const PublishFn& publish_fn) const {
  try {
    publish_fn(compress(image, options()));
  } catch (const CodecError& error) {
    complain(error.what());
  }
}

}  // namespace compressed_image_transport
