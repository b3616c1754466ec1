# SPDX-License-Identifier: LGPL-2.1-or-later
"""The contact forces of a run in space: chains over pale grains, the distribution of normal forces, and the directions
of contacts."""
import numpy as np
from matplotlib.collections import LineCollection

import curves
import force_network
from space import scene, walls
from space.camera import OBLIQUE

PALE = (0.93, 0.92, 0.90)
DRAWN_FROM = 1.5       # times the mean force: weaker contacts would hide the chains
LEFT_OUT = f'forces below {DRAWN_FROM:g} times the mean are not drawn'
BINS = 20
WIDEST = 0.6 * force_network.WIDEST  # pictures of space are wider


def panels(run, networks):
    """(figure, name) of each network, with one scale for all."""
    scale = force_network.force_scale(networks)
    frame = scene.frame(run, [network.grains for network in networks], OBLIQUE)
    return [(panel(run, frame, network, scale), f'force_network-{k}') for k, network in enumerate(networks)]


def panel(run, frame, network, scale):
    result, axes, below = scene.axes_for(frame, bar=True)
    result.set_label(force_network.in_words(run, network))
    scene.draw_box(axes, frame)
    walls.draw(axes, run, frame, network.grains.time / run.scale('t_c'))
    pale = np.tile(PALE, (len(network.grains.radii), 1))
    image = scene.image_of(frame, run, network.grains, pale)
    image[..., 3] *= 0.55
    axes.imshow(image, origin='lower', extent=frame.extent, zorder=1, interpolation='antialiased')
    axes.add_collection(lines(frame.camera, network, scale))
    axes.set_title(scene.title(run, network.grains.time), fontsize=10)
    below.set_axis_off()
    force_network.add_widths(below, scale, run.solid_unit(), WIDEST, loc='center', fontsize=8)
    return result


def lines(camera, network, scale):
    """The strong contacts, the strongest on top."""
    size = np.abs(network.forces)
    order = np.argsort(size)
    order = order[size[order] >= DRAWN_FROM * size.mean()]
    seen = camera.seen(network.ends[order])[..., :2]
    colours = np.where(network.forces[order] >= 0.0, force_network.PUSH, force_network.PULL)
    widths = WIDEST * np.clip(size[order] / scale, force_network.THINNEST, 1.0)
    return LineCollection(seen, linewidths=widths, colors=colours, capstyle='round', zorder=2)


def statistics(networks):
    """(figure, name) of P(f/<f>) and of how upright contacts between grains are; empty without enough of them."""
    shown = force_network.with_distribution(networks)
    return [force_network.normal_forces(shown), contact_directions(shown)] if shown else []


def contact_directions(shown):
    result, upright = curves.panel('Directions of contacts', r'$|n_y|$', r'$P(|n_y|)$')
    for k, network in enumerate(shown):
        upright.plot(*steepness(network), **force_network.line_style(shown, k))
    upright.axhline(1.0, color='black', linewidth=0.6)
    upright.set_ylim(bottom=0.0)
    upright.legend(fontsize=8)
    return result, 'contact_directions'


def steepness(network):
    """(middles of the bins, probability density) of |n_y|: 1 everywhere if no direction is preferred."""
    upwards = np.abs(network.normals[network.between_grains, 1])
    density, edges = np.histogram(upwards, bins=BINS, range=(0.0, 1.0), density=True)
    return 0.5 * (edges[1:] + edges[:-1]), density
