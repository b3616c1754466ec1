# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures and statements of Topin et al. 2011, J. Non-Newtonian Fluid Mech. 166, 63-72, from the runs of
configs/paper.yaml. What has not been played yet is left out, and said in the table."""
