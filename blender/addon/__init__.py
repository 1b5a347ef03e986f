"""Tress for Blender: highly coiled hair edited in curvature space.

The panel is in the sidebar of the 3D viewport, under Tress, whenever a hair curves object is
active. What works on strands is the package `tress`, which the extension carries as a wheel; this
add-on turns curves objects into grooms and back.

| module | holds |
|---|---|
| `hair` | curves objects as grooms; the original kept; attributes |
| `hair_operator` | what operators have in common |
| `edits` | operators: fit, ruffle, recoil, blend, switchbacks, restore |
| `growth` | operator: hair grown from guides on a mesh |
| `colors` | operators: colour by a quantity |
| `rig`, `rig_operators` | an armature of empties that moves hair while they are dragged |
| `files`, `columns` | import and export, with attributes |
| `cache` | animated files played back |
| `panel` | the panel |
"""

import platform
import sys

try:
    import tress as _tress  # noqa: F401
except ImportError as error:
    machine = f"{platform.system()} on {platform.machine()}, Python {sys.version.split()[0]}"
    raise ImportError(
        f"the package tress that this extension carries is not for {machine}: {error}"
    ) from error

from . import cache, colors, edits, files, growth, panel, rig, rig_operators

MODULES = (cache, edits, growth, colors, rig, rig_operators, files, panel)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
