// SPDX-License-Identifier: BSD-3-Clause
#include "graph/correction_reason.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace pose_graph {

const char* toString(CorrectionReason reason) {
  switch (reason) {
    case CorrectionReason::None: return "None";
    case CorrectionReason::ClosuresAccepted: return "ClosuresAccepted";
    case CorrectionReason::ClosureAsserted: return "ClosureAsserted";
    case CorrectionReason::ClosuresRejected: return "ClosuresRejected";
    case CorrectionReason::ClosuresRemoved: return "ClosuresRemoved";
    case CorrectionReason::Refined: return "Refined";
    case CorrectionReason::Levelled: return "Levelled";
  }
  return "";
}

void explain(Relaxed::Correction& correction, const std::vector<ClosureId>& accepted_before,
             const std::vector<Closure>& removed, const std::map<ClosureId, Closure>& closures, bool levelled) {
  std::vector<Closure> accepted, rejected;
  bool asserted = false;
  for (const auto& [id, closure] : closures) {
    const bool now = closure.verdict == ClosureVerdict::Accepted,
               then = std::binary_search(accepted_before.begin(), accepted_before.end(), id);
    if (now && !then) accepted.push_back(closure);
    if (then && !now) rejected.push_back(closure);
    asserted = asserted || (now && !then && isVouchedFor(closure));
  }
  const auto because = [&](CorrectionReason reason, std::vector<Closure> causing_edges, const char* one,
                           const char* many) {
    correction.reason = reason;
    correction.sentence = causing_edges.size() == 1 ? std::string("a closure ") + one
                                                    : std::to_string(causing_edges.size()) + " closures " + many;
    correction.causing_edges = std::move(causing_edges);
  };
  if (!removed.empty() && accepted.empty()) {
    because(CorrectionReason::ClosuresRemoved, removed, "was removed by hand", "were removed by hand");
  } else if (!accepted.empty()) {
    because(asserted ? CorrectionReason::ClosureAsserted : CorrectionReason::ClosuresAccepted, std::move(accepted),
            "is newly accepted", "are newly accepted");
    if (asserted) correction.sentence += ", including an asserted one";
  } else if (!rejected.empty()) {
    because(CorrectionReason::ClosuresRejected, std::move(rejected), "is no longer accepted", "are no longer accepted");
  } else if (levelled) {
    correction.reason = CorrectionReason::Levelled;
    correction.sentence = "map aligned with gravity";
  } else {
    correction.reason = CorrectionReason::Refined;
    correction.sentence = "refined by a batch relaxation with the same closures";
  }
}

}  // namespace pose_graph
