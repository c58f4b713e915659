// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav::testing {

/// Which part of the shared drive a test needs.
struct DrivePart {
  double begin = 0.0, end = 0.0;         ///< s since its start
  std::vector<std::string> topics = {};  ///< prefix of its topics; /tf_static belongs to every part
  std::string misplaced = "";            ///< as `simulate --misplace`: FRAME:ROLL,PITCH,YAW (deg); empty: nothing
  int days = 0;                          ///< by so many days later stamps of headers: another session of the same drive
};

/// Writes a part of the simulated drive that tests share to the bag `to`, and to the folder of the same name with the
/// ending `.truth` the trajectory and the classes that the lasers met, those of the whole drive. The program of this
/// build records the drive if it is missing (test/support/drive.py). Requires the package's folder as working
/// directory.
void cutSharedDrive(const std::string& to, const DrivePart& part);

}  // namespace urban_nav::testing
