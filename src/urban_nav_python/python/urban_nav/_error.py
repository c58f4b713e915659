# SPDX-License-Identifier: BSD-3-Clause
"""The one exception of the module."""


class Error(RuntimeError):
    """What the command would print before it ends with a status other than 0.

    `str(error)` is the text of the command. `status`: 2 for a mistake of the caller (an option, a file, a value), 1 for data that do
    not allow what was asked for.
    """

    def __init__(self, text, status=2):
        super().__init__(text)
        self.status = status

    def __reduce__(self):
        return type(self), (str(self), self.status)
