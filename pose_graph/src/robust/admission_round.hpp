// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linear/index.hpp"
#include "robust/accepted_graph.hpp"
#include "robust/admission_thresholds.hpp"
#include "robust/evidence.hpp"

namespace pose_graph {

/// A round of judging: which closures enter and which leave, by the evidence. `in` says what is inside, `next` what
/// will be.
template <int D>
class AdmissionRound {
 public:
  /// All must outlive it.
  AdmissionRound(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const Thresholds& thresholds,
                 const Evidence& evidence, const std::vector<char>& in)
      : next(in), evaluator_(evaluator), group_(group), thresholds_(thresholds), evidence_(evidence), in_(in) {}

  // `times`: how often each edge has left so far; who left twice stays out.

  /// In, and more than chance can explain. Where information is too modest that is not enough: what it states explains
  /// the residual of one that there is evidence for.
  void expel(std::vector<int>& times);
  /// Out, fits, and has evidence: the better half, or all once they are fewer than those inside.
  void admit(const std::vector<int>& times, double least);
  /// Out, fits, and has evidence, where among many that are right one more is likely to be.
  void admitLikely(const std::vector<int>& times);
  /// Where odometry is too vague for evidence: the largest groups that support each other and fit as a whole.
  void admitGroups(const std::vector<int>& times);
  /// Two parts that nothing joins: the largest group between them, if there are two.
  void join(const AcceptedGraph<D>& graph, const std::vector<int>& times);

  std::vector<char> next;
  std::size_t changes = 0, admitted = 0;
  bool joined = false;

 private:
  double limit(int e) const { return findLimit(thresholds_, evaluator_.edge(e)); }
  double asStated() const { return std::min(1.0, evidence_.variance); }
  bool outAndFits(int e) const { return !in_[sz(e)] && evidence_.chi2[sz(e)] * asStated() <= limit(e); }
  bool excused(int e, double off) const;
  void let(int e);

  const ClosureEvaluator<D>& evaluator_;
  const std::vector<int>& group_;
  const Thresholds& thresholds_;
  const Evidence& evidence_;
  const std::vector<char>& in_;
};

extern template class AdmissionRound<2>;
extern template class AdmissionRound<3>;

}  // namespace pose_graph
