// SPDX-License-Identifier: MIT
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <string>

#include "ardee_sim/description/setting.h"

namespace ardee::node {

/// Converts a value of the parameter server. `path` is its full name. Throws Error for a date or
/// bytes.
Setting to_setting(const std::string& path, XmlRpc::XmlRpcValue& value);

/// The parameter of that full name on the parameter server; a setting that does not exist if there
/// is none.
Setting setting_from_ros(const std::string& name);

}  // namespace ardee::node
