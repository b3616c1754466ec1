# SPDX-License-Identifier: LGPL-2.1-or-later
"""Captions of the figures of a report, with numbers. Missing numbers are left out."""
import findings
from analysis import peaks, relaxation
from force_network import LARGEST_PART, THINNEST, force_scale


def sequence(run, pictures):
    fastest, quickest = fastest_fluid(pictures), fastest_grain(pictures)
    times = ', '.join(f'{p.time / run.scale("t_c"):.3g}' for p in pictures)
    text = ['Lengths in D.']
    if quickest and (run.in_space() or not run.is_wet()):
        text.append('Colour: speed of the grains on one scale for all pictures. Fastest here: '
                    f'{quickest[0] / run.scale("u_c"):.3g} u_c at t = '
                    f'{quickest[1] / run.scale("t_c"):.3g} t_c.')
    if fastest:
        text.append('Colour: vertical velocity of the fluid on one scale for all pictures, red up, blue '
                    f'down. Fastest here: {fastest[0] / run.scale("u_c"):.3g} u_c at t = '
                    f'{fastest[1] / run.scale("t_c"):.3g} t_c.')
    return ' '.join(text + [f'Times: {times} t_c.'])


def shown_part(run, size):
    """Where pictures leave out a part of the box."""
    whole = run.size()
    return '' if tuple(size) == tuple(whole) else (f' Shown are {size[0]:g} x {size[1]:g} D of the box, '
                                                   f'{whole[0]:g} x {whole[1]:g} D.')


def fastest_fluid(pictures):
    """(largest |vertical velocity|, its time) of the pictures with a field; None without any."""
    seen = [(float(abs(p.velocity.vertical).max()), p.time) for p in pictures if p.velocity is not None]
    return max(seen) if seen else None


def fastest_grain(pictures):
    """(largest speed, its time) of the pictures with grain velocities; None without any."""
    seen = [(float(p.grains.speeds().max()), p.time) for p in pictures
            if p.grains is not None and p.grains.velocities is not None and len(p.grains.radii)]
    return max(seen) if seen else None


def collapse(run):
    """For Fig. 8(a): the peak of the mean velocity, and the position of the front."""
    text = []
    highest = peaks.peak(run)
    if highest:
        text.append(f'Largest |<u>|: {highest.value:.4g} u_c at t = {highest.time:.4g} t_c.')
    text += [part for part in [relaxation.caption(run)] if part]
    text += [part for part in [front_caption(run)] if part]
    removed = grains_lost(run)
    if removed:
        text.append(f'{removed} grains left the box; means are over the remaining ones.')
    return ' '.join(text + [rest(run)])


def front_caption(run):
    """Where the front goes; empty without one at the end, and where held grains are farther than it. At a wall it says no
    more than when it came there."""
    _, front = run.column('front_x')
    end = run.end('front_x')
    if end is None or not run.front_is_free():
        return ''
    arrival = run.front_arrives() if run.case.get('domain.right') == 'wall' else None
    if arrival is not None:
        return f'Front from {front[0]:.4g} D to the right wall, where it is at t = {arrival:.3g} t_c.'
    return f'Front from {front[0]:.4g} D to {end:.4g} D.'


def grains_lost(run):
    _, grains = run.column('grains')
    return int(grains[0] - grains[-1]) if len(grains) else 0


def settling(run):
    """For Fig. 3: speeds, start and end heights, time of coming to rest."""
    text = []
    time, velocity = run.column('mean_velocity_y')
    if len(velocity):
        fall = velocity.argmin()
        text.append(f'Fastest mean fall: {max(0.0, -velocity[fall]):.4g} u_c at t = {time[fall]:.4g} t_c.')
    _, position = run.column('mean_position_y')
    end = run.end('mean_position_y')
    if end is not None and not run.has_cyclic_floor():  # else positions start again at the top
        text.append(f'Mean position from {position[0]:.4g} D to {end:.4g} D.')
    return ' '.join(text + [rest(run)])


def rest(run):
    part = f'{100 * findings.REST_FRACTION:g} % of its maximum'
    since = findings.rest_time(run)
    time, speed = run.column('mean_speed')
    end = run.end('mean_speed')
    if since is not None:
        return (f'At rest from t = {since:.4g} t_c on (the mean speed stays below {part}).'
                + ''.join(f' This depends on the time step: {warning["text"]}' for warning in run.warnings('courant')))
    if end is not None and speed.max() > 0.0:
        return (f'Not at rest at the end, t = {time[-1]:.4g} t_c: the mean speed is '
                f'{100 * end / speed.max():.3g} % of its maximum.')
    return ''


def force_network(run, networks, left_out=f'those below {100 * THINNEST:g} % of that are not drawn'):
    """The force of the widest lines, and their position."""
    counts = ', '.join(f'{len(network.forces)} at t = {network.time:.3g} t_c' for network in networks)
    strongest = max(networks, key=lambda network: abs(network.forces).max())
    scale = force_scale(networks)
    wider = sum(int((abs(network.forces) > scale).sum()) for network in networks)
    return ('Lines join grains in contact, as wide as their normal force (red repulsive, blue attractive), on one '
            f'scale for all pictures: the widest stand for {scale:.3g} rho_s g {run.solid_unit()}, which '
            f'{100 * LARGEST_PART:g} % of the contacts do not exceed in the middle one of the outputs, and for more '
            f'({wider} lines); {left_out}. Contacts with an impulse: '
            f'{counts}{held_apart(networks)}. Largest force: {abs(strongest.forces).max():.3g} rho_s g '
            f'{run.solid_unit()} at t = {strongest.time:.3g} t_c.')


def held_apart(networks):
    """How many more there are that films of liquid hold apart; empty without any."""
    if not any(network.films for network in networks):
        return ''
    counts = ', '.join(f'{network.films} at t = {network.time:.3g} t_c' for network in networks)
    return f'; held apart by films of liquid, and not shown: {counts}'


def contact_statistics(run):
    text = ['Probability density of normal forces between grains over their mean, and of the '
            'directions of contacts between grains, each counted both ways.']
    coordination = run.end('coordination')
    if coordination is not None:
        text.append(f'Coordination at the end: {coordination:.3g} contacts per grain.')
    return ' '.join(text)


def motion(run):
    text = []
    overlap = findings.largest(run, 'max_penetration', 'penetration')
    if overlap is not None:
        text.append(f'Largest overlap of any window: {overlap:.3g} D (dotted); the curve has the windows with output.'
                    if findings.covers_all(run) else f'Largest overlap of {findings.extent(run)}: {overlap:.3g} D.')
    contacts = run.end('contacts')
    if contacts is not None:
        text.append(f'Contacts with an impulse at the end: {contacts:.0f}.')
    return ' '.join(text)


def packing(run):
    """The loosest packing, and the share of sliding contacts at the end."""
    text = []
    _, pores = run.column('pore_volume')
    end = run.end('pore_volume')
    if end is not None and pores[0] > 0.0 and run.is_packed():
        text.append(f'Pores from {pores[0]:.4g} {run.solid_unit()} to {end:.4g} {run.solid_unit()} '
                    f'({100 * (end / pores[0] - 1):+.3g} %).')
    sliding = run.end('sliding_share')
    if sliding is not None and run.has_friction():
        text.append(f'Sliding contacts at the end: {100 * sliding:.3g} %.')
    return ' '.join(text)


def solvers(run):
    """The checks over all windows, and the mean numbers of iterations."""
    text = []
    balances = [('grains', 'grain_balance'), *([('fluid', 'fluid_balance')] if run.is_wet() else [])]
    defects = [(name, findings.largest(run, column, column)) for name, column in balances]
    told = ', '.join(f'{name} {defect:.2g}' for name, defect in defects if defect is not None)
    if told:
        dotted = ' (dotted)' if findings.covers_all(run) else ''
        text.append(f'Largest momentum defect of {findings.extent(run)}{dotted}: {told}.')
    divergence = findings.largest(run, 'divergence', 'divergence')
    if divergence is not None and run.is_wet():
        text.append(f'Largest divergence after step 1: {divergence:.2g} u_c/D.')
    maxima = run.record.get('maxima') or {}
    if maxima.get('final_divergence'):
        text.append(f'Largest divergence after step 5, in windows with output: {maxima["final_divergence"]:.2g} '
                    'u_c/D (large, since the grains are not part of the volume balance). Largest Courant number: '
                    f'{maxima["courant"]:.2g}.')
    for name, column in (('sub-steps' if run.has_springs() else 'contact sweeps', 'contact_iterations'),
                         ('multiplier iterations', 'multiplier_iterations'),
                         ('joint rounds', 'joint_rounds'),
                         ('pressure iterations with rigid grains', 'pressure_iterations')):
        _, count = run.column(column)
        if len(count):
            text.append(f'{name.capitalize()}: {count.mean():.3g} on average, {count.max():.0f} at most '
                        'in the rows.')
    text += [f'Windows in which {what}: {count}.' for what, count in findings.unconverged(run)]
    return ' '.join(text)


def wall_time(wall):
    """Seconds of the run by participant."""
    total = wall.total(wall.window)
    windows = wall.windows.sum()
    parts = '; '.join(f'{name} {wall.total(part):.3g} s ({1e3 * wall.total(part) / windows:.3g} ms per '
                      f'window)' for name, part in wall.parts.items())
    text = (f'{windows:.0f} windows took {total:.4g} s, {1e3 * total / windows:.3g} ms each: {parts}; '
            f'rest {wall.total(wall.rest()):.3g} s. Each value is a mean over an output interval.')
    if wall.overlaps():
        text += (' Fluid and grains work at the same time, so the parts add up to more than the window '
                 'where they overlap.')
    return text
