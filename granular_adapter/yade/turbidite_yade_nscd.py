# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE as the grains participant with the contact engine: `yade -n -x turbidite_yade_nscd.py RUN`, started by
`turbidite run` with grains.adapter: yade-nscd.
"""
import participant_process  # before anything else: see there


def parts():
    import turbidite_yade
    from nscd_scene import Scene
    return turbidite_yade.Participant, Scene()


participant_process.take_part(parts)
