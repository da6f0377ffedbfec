// SPDX-License-Identifier: MIT
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <string>

#include "ardee_sim/description/setting.h"

namespace ardee::node {

/// A value of the parameter server. `path` is its full name. Throws Error for a date or bytes.
Setting to_setting(const std::string& path, XmlRpc::XmlRpcValue& value);

/// What the parameter server has of that full name; nothing if it has none.
Setting setting_from_ros(const std::string& name);

}  // namespace ardee::node
