// SPDX-License-Identifier: MIT
#include "ros/setting_from_ros.h"

#include <ros/names.h>
#include <ros/param.h>

#include "ardee_sim/core/error.h"

namespace ardee::node {
namespace {

Setting::List to_list(const std::string& path, XmlRpc::XmlRpcValue& values) {
  Setting::List list;
  for (int i = 0; i < values.size(); ++i) {
    list.push_back(to_setting(path + "[" + std::to_string(i) + "]", values[i]));
  }
  return list;
}

Setting::Map to_map(const std::string& path, XmlRpc::XmlRpcValue& values) {
  Setting::Map map;
  for (auto& [key, value] : values) map.emplace(key, to_setting(path + "/" + key, value));
  return map;
}

Setting::Value to_value(const std::string& path, XmlRpc::XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeInvalid:
      return std::monostate();
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value);
    case XmlRpc::XmlRpcValue::TypeInt:
      return static_cast<int>(value);
    case XmlRpc::XmlRpcValue::TypeDouble:
      return static_cast<double>(value);
    case XmlRpc::XmlRpcValue::TypeString:
      return static_cast<std::string>(value);
    case XmlRpc::XmlRpcValue::TypeArray:
      return to_list(path, value);
    case XmlRpc::XmlRpcValue::TypeStruct:
      return to_map(path, value);
    case XmlRpc::XmlRpcValue::TypeDateTime:
    case XmlRpc::XmlRpcValue::TypeBase64:
      break;
  }
  throw Error(path +
              ": found a date or bytes, expected a number, a truth, a text, a list or a "
              "group");
}

}  // namespace

Setting to_setting(const std::string& path, XmlRpc::XmlRpcValue& value) {
  return {path, to_value(path, value)};
}

Setting setting_from_ros(const std::string& name) {
  std::string why;
  if (!ros::names::validate(name, why)) {
    throw Error("found '" + name + "' as the name of a parameter, expected a valid one: " + why);
  }
  XmlRpc::XmlRpcValue value;
  if (!ros::param::get(name, value)) return {name, {}};
  return to_setting(name, value);
}

}  // namespace ardee::node
