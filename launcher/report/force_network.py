# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the contact forces: the force network over the grains, the distribution of normal forces and the
directions of contacts."""
from dataclasses import dataclass, replace

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D

import curves
import grain_drawing
import pictures

WIDEST = 4.0            # points, of the line of the largest force drawn at scale
LARGEST_PART = 0.95     # quantile of the forces of an output that gets the full width, as do larger ones
LEGEND = (0.25, 0.5, 1.0)  # of the full width
OF_A_GRAIN = 0.7        # the widest line, at most
THINNEST = 0.08         # of the widest; thinner lines are invisible
PUSH, PULL = '#b3261e', '#1d5fa8'
BINS_FORCE, BINS_ANGLE = 30, 36
LARGEST_FORCE = 6.0     # f/<f> in the distribution
FEWEST_CONTACTS = 50    # for a distribution


@dataclass
class Network:
    """Contacts with an impulse at one time, d = 2 or in space 3; forces over rho_s g D^d."""

    time: float           # t_c
    grains: object        # grain_files.Grains
    ends: np.ndarray      # (n, 2, d) of the line that represents a contact [D]
    normals: np.ndarray   # (n, d) unit
    forces: np.ndarray    # (n,) along the normal, > 0 repulsive
    between_grains: np.ndarray  # (n,) bool; others are at walls
    films: int = 0        # points held apart by films of liquid, which are not among these


def view(run, networks):
    """Width and height of the pictures [D]: there is nothing to see where there are no grains."""
    return pictures.reached(run, [network.grains for network in networks], pictures.MARGIN)


def figure(run, networks):
    """The networks side by side, line width proportional to the force, with one scale for all."""
    scale, size = force_scale(networks), view(run, networks)
    result, axes = pictures.frame(size, len(networks), pictures.LABEL_WIDTH)
    for network, place in zip(networks, axes.flat):
        draw(run, place, network, scale, size)
    add_widths(axes.flat[0], scale, run.solid_unit(), widest_line(axes.flat[0], size), loc='upper right', fontsize=6)
    return result


def panels(run, networks):
    """(figure, name) of each network, with one scale for all."""
    scale, size = force_scale(networks), view(run, networks)
    return [(panel(run, network, scale, size), f'force_network-{k}') for k, network in enumerate(networks)]


def panel(run, network, scale, size):
    """One network, with the widths of its lines below it."""
    result, axes, below = pictures.panel_axes(size, bar=True)
    result.set_label(in_words(run, network))
    draw(run, axes, network, scale, size)
    below.set_axis_off()
    add_widths(below, scale, run.solid_unit(), widest_line(axes, size), loc='center', fontsize=7)
    return result


def draw(run, axes, network, scale, size):
    grain_drawing.draw(axes, grain_drawing.with_images(run, network.grains), run.scale('D'), alpha=0.45)
    axes.add_collection(lines(seen(run, network), scale, widest_line(axes, size)))
    pictures.decorate(run, axes, size, network.grains.time)


def seen(run, network):
    """The network with the images of its lines."""
    chosen, ends = grain_drawing.lines_with_images(run, network.ends)
    return replace(network, ends=ends, normals=network.normals[chosen], forces=network.forces[chosen],
                   between_grains=network.between_grains[chosen])


def add_widths(axes, scale, unit, widest=WIDEST, **how):
    """A legend of the widths; `unit` is the D^2 or D^3 of the forces."""
    shown = [Line2D([], [], color=PUSH, linewidth=share * widest, solid_capstyle='butt') for share in LEGEND]
    texts = [rf'{share * scale:.2g}' for share in LEGEND[:-1]] + [rf'$\geq$ {scale:.2g} $\rho_s g {unit}$']
    axes.legend(shown, texts, ncol=len(LEGEND), frameon=False, handlelength=1.6, columnspacing=1.2, **how)


def in_words(run, network):
    """What a picture shows, for those who do not see it."""
    return (f'{pictures.grains_in_words(run, network.grains, network.grains.time)}, with lines along their '
            f'{len(network.forces)} contacts; largest force {np.abs(network.forces).max():.3g} rho_s g {run.solid_unit()}')


def force_scale(networks):
    """The force of full width: what LARGEST_PART of the contacts do not exceed in the middle one of the outputs, each
    counted with its contacts. An impact at one output leaves the others as they are."""
    there = sorted((float(np.quantile(np.abs(network.forces), LARGEST_PART)), len(network.forces)) for network in networks
                   if len(network.forces))
    if not there:
        return 1.0
    forces, counts = np.transpose(there)
    return float(forces[np.searchsorted(np.cumsum(counts), 0.5 * counts.sum())])


def widest_line(axes, size):
    """Points; not wider than most of a grain."""
    return min(WIDEST, OF_A_GRAIN * 72.0 * axes.get_position().width * axes.figure.get_figwidth() / size[0])


def lines(network, scale, widest=WIDEST):
    """Draws weak contacts first, so that strong ones are on top."""
    order = np.argsort(np.abs(network.forces))
    part = np.clip(np.abs(network.forces[order]) / scale, 0.0, 1.0)
    seen = part >= THINNEST
    colours = np.where(network.forces[order][seen] >= 0.0, PUSH, PULL)
    return LineCollection(network.ends[order][seen], linewidths=widest * part[seen], colors=colours,
                          capstyle='round')


def statistics(networks):
    """(figure, name) of P(f/<f>) and of the directions of contacts between grains, one curve per network with at least
    50 of them; empty without any."""
    shown = with_distribution(networks)
    return [normal_forces(shown), contact_directions(shown)] if shown else []


def with_distribution(networks):
    """Those with contacts enough."""
    return [network for network in networks if network.between_grains.sum() >= FEWEST_CONTACTS]


def line_style(networks, k):
    """Of the k-th of these."""
    return dict(linewidth=1.2, linestyle=curves.dash(k), color=curves.in_order(k, len(networks)),
                label=rf'$t = {networks[k].time:.3g}\,t_c$')


def normal_forces(shown):
    result, forces = curves.panel('Normal forces', r'$f\,/\,\langle f \rangle$', r'$P(f\,/\,\langle f \rangle)$')
    for k, network in enumerate(shown):
        forces.plot(*distribution(network), marker='.', **line_style(shown, k))
    forces.set_yscale('log')
    forces.legend(fontsize=8)
    return result, 'contact_forces'


def contact_directions(shown):
    result = plt.figure(figsize=curves.PANEL, layout='constrained')
    polar = result.add_subplot(projection='polar')
    for k, network in enumerate(shown):
        polar.plot(*directions(network), **line_style(shown, k))
    polar.set_title('Directions of contacts', fontsize=10)
    polar.tick_params(labelsize=8)
    polar.set_rlabel_position(80)
    return result, 'contact_directions'


def distribution(network):
    """(centres of the bins, probability density) of repulsive forces over their mean; without empty bins."""
    forces = network.forces[network.between_grains]
    forces = forces[forces > 0.0]
    density, edges = np.histogram(forces / forces.mean(), bins=BINS_FORCE, range=(0.0, LARGEST_FORCE))
    density = density / (len(forces) * (edges[1] - edges[0]))
    middles = 0.5 * (edges[1:] + edges[:-1])
    return middles[density > 0.0], density[density > 0.0]


def directions(network):
    """(angles, probability density) of contact normals, each with its opposite, as a closed curve."""
    normals = network.normals[network.between_grains]
    angles = np.arctan2(normals[:, 1], normals[:, 0])
    both = np.concatenate([angles, angles + np.pi]) % (2.0 * np.pi)
    density, edges = np.histogram(both, bins=BINS_ANGLE, range=(0.0, 2.0 * np.pi))
    density = density / (len(both) * (edges[1] - edges[0]))
    middles = 0.5 * (edges[1:] + edges[:-1])
    return np.append(middles, middles[0] + 2.0 * np.pi), np.append(density, density[0])
