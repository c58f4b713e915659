// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/problem.hpp"
