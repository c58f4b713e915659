// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Telegrams from the host to an LMS291.
Bytes lmsStopCommand();
Bytes lmsStreamAllCommand();
/// Requests a stream of ranges and reflectivities of the beams `first`...`last`, 1-based.
Bytes lmsStreamReflectivitiesCommand(int first = 1, int last = 181);
Bytes lmsPollCommand();
Bytes lmsStatusCommand();
Bytes lmsErrorsCommand();
Bytes lmsTypeCommand();
Bytes lmsConfigurationCommand();
Bytes lmsInstallationCommand();
Bytes lmsResetCommand();
/// Returns nullopt for a rate other than 9600, 19200, 38400, 500000.
std::optional<Bytes> lmsBaudCommand(int baud);
/// Writes a configuration of the length reported by the device, in installation mode.
Bytes lmsWriteConfigurationCommand(ByteView configuration);

}  // namespace segway_drivers
