// SPDX-License-Identifier: MIT
#include <pluginlib/class_list_macros.hpp>

#include "compressed_publisher.h"
#include "compressed_subscriber.h"

PLUGINLIB_EXPORT_CLASS(compressed_image_transport::CompressedPublisher,
                       image_transport::PublisherPlugin)
PLUGINLIB_EXPORT_CLASS(compressed_image_transport::CompressedSubscriber,
                       image_transport::SubscriberPlugin)
