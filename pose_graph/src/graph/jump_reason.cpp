// SPDX-License-Identifier: BSD-3-Clause
#include "graph/jump_reason.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace pose_graph {

const char* toString(JumpReason reason) {
  switch (reason) {
    case JumpReason::None: return "None";
    case JumpReason::Believed: return "Believed";
    case JumpReason::Asserted: return "Asserted";
    case JumpReason::Withdrawn: return "Withdrawn";
    case JumpReason::Removed: return "Removed";
    case JumpReason::Refined: return "Refined";
    case JumpReason::Levelled: return "Levelled";
  }
  return "";
}

void explain(Relaxed::Jump& jump, const std::vector<ClosureId>& accepted_before, const std::vector<Closure>& removed,
             const std::map<ClosureId, Closure>& closures, bool levelled) {
  std::vector<Closure> believed, withdrawn;
  bool asserted = false;
  for (const auto& [id, closure] : closures) {
    const bool now = closure.verdict == ClosureVerdict::Accepted,
               then = std::binary_search(accepted_before.begin(), accepted_before.end(), id);
    if (now && !then) believed.push_back(closure);
    if (then && !now) withdrawn.push_back(closure);
    asserted = asserted || (now && !then && closure.kind == EdgeKind::Asserted);
  }
  const auto because = [&](JumpReason reason, std::vector<Closure> witnesses, const char* one, const char* many) {
    jump.reason = reason;
    jump.sentence = witnesses.size() == 1 ? std::string("a closure ") + one
                                          : std::to_string(witnesses.size()) + " closures " + many;
    jump.witnesses = std::move(witnesses);
  };
  if (!removed.empty() && believed.empty()) {
    because(JumpReason::Removed, removed, "was removed by hand", "were removed by hand");
  } else if (!believed.empty()) {
    because(asserted ? JumpReason::Asserted : JumpReason::Believed, std::move(believed), "is believed now",
            "are believed now");
    if (asserted) jump.sentence += ", one that was asserted among them";
  } else if (!withdrawn.empty()) {
    because(JumpReason::Withdrawn, std::move(withdrawn), "is no longer believed", "are no longer believed");
  } else if (levelled) {
    jump.reason = JumpReason::Levelled;
    jump.sentence = "which way is up is known now: the map is level";
  } else {
    jump.reason = JumpReason::Refined;
    jump.sentence = "relaxed from the measurements alone, the same closures place it here";
  }
}

}  // namespace pose_graph
