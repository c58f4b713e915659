// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dense_stereo/parameters.hpp"

namespace dense_stereo {

/// Throws UserError, naming the commands that have the others, if `Parameters::method` names another method than the
/// stage's own, semi-global matching.
void requireOwnMethod(const Parameters& parameters);

}  // namespace dense_stereo
