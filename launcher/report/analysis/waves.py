# SPDX-License-Identifier: LGPL-2.1-or-later
"""Waves on a granular flow: crests in front of troughs, while the grains move essentially horizontally (Topin et al. 2011,
section 3.2: "in this last regime, fluid recirculations are observed leading to the formation of waves at the surface of
the granular flow"). Before that a block that slides as a whole leaves a trough behind it, which is no wave.

The height of the flow is its solid area per length of floor, in columns of 4 D, so that single grains in the liquid above
it count for little; a grain is spread evenly over its width. Followed to the right from its highest column, the height of
a heap only falls; where it rises again, by more than the lowest height so far, there is a crest.
"""
import numpy as np

from analysis import phases, snapshots

WIDTH = 4.0        # D
LEAST_CREST = 1.0  # D of solid: a lower one is the roughness of a heap


def thickness(run, snapshot):
    """Solid area over length of floor [D]."""
    edges = np.arange(0.0, run.size()[0] + WIDTH, WIDTH)
    places = (edges[:, None] - snapshot.centres[:, 0]) / (2.0 * snapshot.radii) + 0.5
    return np.diff((np.clip(places, 0.0, 1.0) * snapshot.areas).sum(axis=1)) / WIDTH


def crest(heights):
    """The largest rise over the lowest height so far, to the right of the highest column [D]."""
    falling = heights[int(heights.argmax()):]
    return float((falling - np.minimum.accumulate(falling)).max())


def largest_crest(run):
    """Of the snapshots from its horizontal phase on in which an avalanche flows horizontally [D]; None without any."""
    found = phases.phases(run)
    if found is None or found.flat is None:
        return None
    flat = {one.time for one in phases.moments(run) if one.is_flat() and one.time >= found.flat.time}
    crests = [crest(thickness(run, one)) for one in snapshots.snapshots(run) if one.time in flat]
    return max(crests, default=None)
