# SPDX-License-Identifier: LGPL-2.1-or-later
"""The index of a series of files for ParaView (.pvd)."""
import xml.etree.ElementTree as ElementTree


def entries(run, index):
    """Its entries (`timestep`, `part`, `file`). A kill, a full disk or a run at work may have left it without its end: then
    those that are whole, and a remark."""
    found = []
    try:
        for _, element in ElementTree.iterparse(index):
            if element.tag == 'DataSet':
                found.append(element)
    except ElementTree.ParseError as error:
        remark = f'{index.relative_to(run.folder)} is cut off or damaged after {len(found)} whole entries: {error}'
        if remark not in run.remarks:
            run.remarks.append(remark)
    return found
