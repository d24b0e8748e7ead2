# SPDX-License-Identifier: GPL-3.0-or-later
"""What is kept in memory: the last simplified polycube, so that the Simplicity slider can move along what was found,
the last hexahedra, so that they can be cut open elsewhere, and the last polycube that was made, so that it is made
once."""

import random

import polycube

from . import colours, results


class _Last:
    """The search that the slider moves along."""

    token = 0
    source = None
    found = None
    shown = None
    still = False


class _Hexes:
    """The last hexahedra, which the slider cuts open."""

    token = 0
    hexahedra = None


class _Made:
    """The last polycube that was made of a plain shape, and of what."""

    key = None
    made = None


def keep_made(source, making, made):
    """Keeps what was made of a plain shape."""
    _Made.key, _Made.made = (source.fingerprint, making), made


def made_of(source, making):
    """What was made of this very shape, or None."""
    return _Made.made if _Made.key == (source.fingerprint, making) else None


def remember(source, found):
    """Keeps a result; gives the token by which the scene tells that it shows this one."""
    _Last.token = _token()
    _Last.source, _Last.found, _Last.shown = source, found, found
    return _Last.token


def _token():
    # A scene keeps its token in its file, so those of other sessions must not be met again by counting.
    return random.randrange(1, 2**31)


def keep_hexes(hexahedra):
    """Keeps hexahedra to cut open; gives the token by which the scene tells that it shows these."""
    _Hexes.token, _Hexes.hexahedra = _token(), hexahedra
    return _Hexes.token


def can_cut(settings):
    """Whether the hexahedra that the scene shows are those that are kept."""
    same = _Hexes.hexahedra is not None and settings.result.hexes_token == _Hexes.token
    return same and settings.result.hexes is not None and not settings.result.hexes.data.is_editmode


def cut(settings, _context):
    """Called when the user moves the cut: shows more or less of the hexahedra."""
    if can_cut(settings):
        mesh = settings.result.hexes.data
        _Hexes.hexahedra.fill(mesh, settings.cut_axis, settings.cut)
        colours.paint(mesh, settings.colour)


def forget():
    """Frees the memory."""
    _Last.source = _Last.found = _Last.shown = None
    _Made.key = _Made.made = _Hexes.hexahedra = None


def current(settings):
    """Source and simplified polycube that the scene shows, or None: another file, or an undo before it."""
    same = _Last.found is not None and settings.result.token == _Last.token
    return (_Last.source, _Last.shown) if same else None


def tell(settings, simplicity):
    """Sets the slider without moving anything."""
    _Last.still = True
    settings.simplicity = simplicity
    _Last.still = False


def slide(settings, context):
    """Called when the user moves the slider: changes the result in place."""
    if _Last.still or current(settings) is None or not _Last.found.front:
        return
    try:
        _Last.shown = _Last.found.at(settings.simplicity)
    except polycube.PolycubeError as error:
        settings.result.notes = str(error)
        return
    results.update(context, _Last.source, _Last.shown)
    shown = settings.result.object
    if shown is not None and shown.name in context.view_layer.objects:
        shown.hide_set(False)


def holder(settings):
    """The object that the polycube belongs to, where there is one."""
    return settings.shape if settings.source == 'KEY' else settings.polycube
