# SPDX-License-Identifier: LGPL-2.1-or-later
"""How pages are set: HTML with figures, style, symbols and alternative texts."""
