// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/parameters.hpp"

#include <xmlrpcpp/XmlRpcValue.h>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_ros {

using urban_nav_core::ParameterValue;

std::map<std::string, ParameterValue> serverValues(const ros::NodeHandle& nh) {
  std::map<std::string, ParameterValue> values;
  XmlRpc::XmlRpcValue tree;
  if (!nh.getParam(nh.getNamespace(), tree) || tree.getType() != XmlRpc::XmlRpcValue::TypeStruct) return values;
  for (auto& [name, value] : tree) {
    switch (value.getType()) {
      case XmlRpc::XmlRpcValue::TypeBoolean: values[name] = static_cast<bool>(value); break;
      case XmlRpc::XmlRpcValue::TypeInt: values[name] = static_cast<int>(value); break;
      case XmlRpc::XmlRpcValue::TypeDouble: values[name] = static_cast<double>(value); break;
      case XmlRpc::XmlRpcValue::TypeString: values[name] = static_cast<std::string>(value); break;
      default:
        throw urban_nav_core::UserError(nh.getNamespace() + "/" + name, "a list, a map or binary data",
                                        "true or false, a number, or text");
    }
  }
  return values;
}

}  // namespace urban_nav_ros
