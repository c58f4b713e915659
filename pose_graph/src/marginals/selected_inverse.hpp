// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linear/block_cholesky.hpp"

namespace pose_graph {

/// Returns the blocks of A^-1 on the pattern of A, from the factor of A: from the last supernode to the first, each
/// computed from the inverse on the rows below it (Takahashi, Fagan, Chin 1973; Erisman, Tinney, Comm. ACM 1975), with
/// dense panels. Takes about twice the operations of the factorisation. Instantiated for B = 2, 3, 6.
template <int B>
BlockMatrix<B> selectedInverse(const BlockCholesky<B>& cholesky, const BlockPattern& pattern);

extern template BlockMatrix<2> selectedInverse<2>(const BlockCholesky<2>&, const BlockPattern&);
extern template BlockMatrix<3> selectedInverse<3>(const BlockCholesky<3>&, const BlockPattern&);
extern template BlockMatrix<6> selectedInverse<6>(const BlockCholesky<6>&, const BlockPattern&);

}  // namespace pose_graph
