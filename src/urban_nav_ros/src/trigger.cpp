// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/trigger.hpp"

#include <std_srvs/Trigger.h>

#include <boost/function.hpp>

namespace urban_nav_ros {

ros::ServiceServer advertiseTrigger(ros::NodeHandle& nh, const std::string& name,
                                    const std::function<std::string()>& action) {
  using Request = std_srvs::Trigger::Request;
  using Response = std_srvs::Trigger::Response;
  const boost::function<bool(Request&, Response&)> callback = [action](Request&, Response& response) {
    response.message = action();
    response.success = !response.message.empty();
    return true;
  };
  return nh.advertiseService(name, callback);
}

}  // namespace urban_nav_ros
