// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Returns the likely protocol of a stream without a complete frame of a receiver, as the end of a sentence: "SiRF
/// binary, which is not read: ...", "NMEA whose checksums are wrong or missing", "a wrong line rate ...". Protocols are
/// recognised by frames complete by their rules, a wrong line rate by bytes that are neither text nor such frames.
std::string describeUnknownStream(ByteView bytes);

}  // namespace segway_drivers
