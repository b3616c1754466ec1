# SPDX-License-Identifier: LGPL-2.1-or-later
"""Quantities measured on a run, one idea per file; docs/analysis.md defines them. Lengths in D, times in t_c,
velocities in u_c unless a docstring says otherwise; compression is positive."""
