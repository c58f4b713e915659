// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pose_graph {

/// Logarithm of the density of a true closure's residual. Where information is too modest (`variance`, the factor of
/// all covariances that the residuals show, is below 1) most residuals are normal with that factor, and one in twenty
/// is as the information states: a contaminated normal distribution (Tukey, A survey of sampling from contaminated
/// distributions, 1960), whose wider part is not chosen but said by who measured. Where it boasts, normal with that
/// factor.
///
/// `log_at_zero`: logarithm of the density at no residual at all, covariances as stated. `chi2`: as stated, with `rank`
/// degrees of freedom.
double logInlierLikelihood(double log_at_zero, int rank, double chi2, double variance);

}  // namespace pose_graph
