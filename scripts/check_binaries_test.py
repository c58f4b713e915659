# SPDX-License-Identifier: BSD-3-Clause
import unittest

import check_binaries

PROGRAM = """
  Type:                              DYN (Position-Independent Executable file)
  INTERP         0x000318
  GNU_RELRO      0x02d9f0
 0x000000000000001d (RUNPATH)            Library runpath: [$ORIGIN:$ORIGIN/..:/opt/ros/noetic/lib]
 0x000000000000001e (FLAGS)              BIND_NOW
     1: 0000000000000000     0 FUNC    GLOBAL DEFAULT  UND __stack_chk_fail@GLIBC_2.4 (2)
     2: 0000000000000000     0 FUNC    GLOBAL DEFAULT  UND __memcpy_chk@GLIBC_2.3.4 (3)
"""


class CheckBinariesTest(unittest.TestCase):
    def faults(self, old="", new="", size=check_binaries.LARGE + 1):
        return check_binaries.find_faults(PROGRAM.replace(old, new) if old else PROGRAM, size)

    def test_a_hardened_program_has_no_fault(self):
        self.assertEqual(self.faults(), [])

    def test_libraries_are_not_taken_from_the_current_folder(self):
        for path in ("/opt/ros/noetic/lib:", ":/opt", "/opt::/usr", "lib", "./lib"):
            self.assertEqual(len([f for f in self.faults("/opt/ros/noetic/lib", path) if "current" in f]), 1, path)

    def test_each_flag_is_missed(self):
        for old, words in (("BIND_NOW", "-z now"), ("GNU_RELRO", "-z relro"), ("DYN (", "position-independent"),
                           ("__stack_chk_fail", "stack-protector")):
            self.assertTrue(any(words in f for f in self.faults(old, "?")), words)

    def test_small_files_need_no_guards(self):
        self.assertEqual(self.faults("__stack_chk_fail", "?", size=1000), [])

    def test_checked_functions_are_recognised(self):
        self.assertTrue(check_binaries.is_fortified(PROGRAM))
        self.assertFalse(check_binaries.is_fortified(PROGRAM.replace("__memcpy_chk", "memcpy")))


if __name__ == "__main__":
    unittest.main()
