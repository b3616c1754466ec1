# SPDX-License-Identifier: GPL-3.0-or-later
"""Molecular dynamics by YADE as the grains participant: `yade -n -x turbidite_yade_md.py RUN`, started by
`turbidite run` with grains.adapter: yade-md.
"""
import participant_process  # before anything else: see there


def parts():
    import turbidite_yade
    from md_scene import Scene
    return turbidite_yade.MdParticipant, Scene()


participant_process.take_part(parts)
