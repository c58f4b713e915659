// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dense_stereo/parameters.hpp"

namespace dense_stereo {

/// Throws UserError, naming the commands with other methods, if `Parameters::method` is not semi-global matching.
void requireOwnMethod(const Parameters& parameters);

}  // namespace dense_stereo
