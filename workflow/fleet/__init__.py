# SPDX-License-Identifier: BSD-3-Clause
"""Parts of the workflow that need no engine: which recordings there are, one step of a job, the list of sessions."""
