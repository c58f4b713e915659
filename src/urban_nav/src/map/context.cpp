// SPDX-License-Identifier: BSD-3-Clause
#include "map/context.hpp"

#include <algorithm>

#include "urban_nav_registration/session/calibration_fingerprint.hpp"

namespace urban_nav {

namespace {

/// Returns the elements of `previous` and `own` over all sessions.
template <typename Element>
std::vector<Element> overAll(const MapContext& context, const std::vector<Element>& previous,
                             const std::vector<Element>& own) {
  std::vector<Element> all(previous.size() + own.size());
  std::vector<bool> is_own(all.size(), false);
  for (std::size_t i = 0; i < own.size(); ++i) {
    all[context.number(i)] = own[i];
    is_own[context.number(i)] = true;
  }
  std::size_t next = 0;
  for (std::size_t s = 0; s < all.size(); ++s)
    if (!is_own[s]) all[s] = previous[next++];
  return all;
}

}  // namespace

std::size_t MapContext::number(std::size_t session) const {
  return numbers.empty() ? previous.runs.size() + session : numbers[session];
}

bool MapContext::isPrevious(std::size_t number) const {
  if (numbers.empty()) return number < previous.runs.size();
  return std::find(numbers.begin(), numbers.end(), number) == numbers.end();
}

std::vector<const SessionOdometry*> MapContext::runs() const {
  std::vector<const SessionOdometry*> earlier, own;
  for (const SessionOdometry& run : previous.runs) earlier.push_back(&run);
  for (const MapSession& session : sessions) own.push_back(session.odometry.get());
  return overAll(*this, earlier, own);
}

std::vector<urban_nav_store::SessionId> MapContext::ids() const {
  std::vector<urban_nav_store::SessionId> own;
  for (const MapSession& session : sessions) own.push_back(session.id);
  return overAll(*this, previous.ids, own);
}

std::optional<urban_nav_registration::MountedCamera> MapContext::lastCamera() const {
  using Camera = std::optional<urban_nav_registration::MountedCamera>;
  std::vector<Camera> earlier, own;
  for (const SessionOdometry& run : previous.runs)
    earlier.push_back(urban_nav_registration::parseCalibrationFingerprint(run.cameras));
  for (const MapSession& session : sessions)
    own.push_back(session.info.has_images ? Camera({session.info.camera, session.info.T_base_camera}) : std::nullopt);
  const std::vector<Camera> all = overAll(*this, earlier, own);
  const auto last = std::find_if(all.rbegin(), all.rend(), [](const Camera& camera) { return camera.has_value(); });
  return last == all.rend() ? std::nullopt : *last;
}

}  // namespace urban_nav
