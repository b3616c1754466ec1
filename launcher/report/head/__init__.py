# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report begins with: what happened, whether it held, and the numbers one looks for first."""
