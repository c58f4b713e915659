// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/lms291/commands.hpp"

#include "segway_drivers/lms291/telegram.hpp"

namespace segway_drivers {

Bytes lmsStopCommand() { return makeLmsTelegram(Bytes{0x20, 0x25}); }
Bytes lmsStreamAllCommand() { return makeLmsTelegram(Bytes{0x20, 0x24}); }

Bytes lmsStreamReflectivitiesCommand(int first, int last) {
  Bytes payload = {0x20, 0x50};
  appendLittle(payload, static_cast<std::uint16_t>(first));
  appendLittle(payload, static_cast<std::uint16_t>(last));
  return makeLmsTelegram(payload);
}

Bytes lmsPollCommand() { return makeLmsTelegram(Bytes{0x30, 0x01}); }
Bytes lmsStatusCommand() { return makeLmsTelegram(Bytes{0x31}); }
Bytes lmsErrorsCommand() { return makeLmsTelegram(Bytes{0x32}); }
Bytes lmsTypeCommand() { return makeLmsTelegram(Bytes{0x3A}); }
Bytes lmsConfigurationCommand() { return makeLmsTelegram(Bytes{0x74}); }
Bytes lmsResetCommand() { return makeLmsTelegram(Bytes{0x10}); }

Bytes lmsInstallationCommand() { return makeLmsTelegram(Bytes{0x20, 0x00, 'S', 'I', 'C', 'K', '_', 'L', 'M', 'S'}); }

std::optional<Bytes> lmsBaudCommand(int baud) {
  switch (baud) {
    case 9600: return makeLmsTelegram(Bytes{0x20, 0x42});
    case 19200: return makeLmsTelegram(Bytes{0x20, 0x41});
    case 38400: return makeLmsTelegram(Bytes{0x20, 0x40});
    case 500000: return makeLmsTelegram(Bytes{0x20, 0x48});
    default: return std::nullopt;
  }
}

Bytes lmsWriteConfigurationCommand(ByteView configuration) {
  Bytes payload = {0x77};
  payload.insert(payload.end(), configuration.begin(), configuration.end());
  return makeLmsTelegram(payload);
}

}  // namespace segway_drivers
