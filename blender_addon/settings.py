# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user chooses: the inputs in the panel, and the options that panel and operators share.

An option is declared once, in a mix-in class. The scene's settings hold what the panel shows; an operator has the same
properties for its redo panel and for scripts, and takes those that were not given from the scene (see
`Options.settle`).
"""

import math

import bpy
from bpy.props import (
    BoolVectorProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    IntVectorProperty,
    PointerProperty,
    StringProperty,
)

from . import colours, live

# Operators shall not remember what they were given last: the panel says what is asked for.
FORGET = {'SKIP_SAVE'}

SIMPLICITY = {
    "name": "Simplicity",
    "description": "From 0, facets stay as near as they can to where they are, to 1, the fewest blocks. After Simplify "
    "it moves along what the search has found and changes the result at once",
    "min": 0.0,
    "max": 1.0,
    "default": 1.0,
    "subtype": 'FACTOR',
}


def is_mesh(_settings, obj):
    """What the panel offers as a shape or polycube."""
    return obj.type == 'MESH'


class Options:
    """What every group of options can do."""

    @classmethod
    def names(cls):
        """The names of the options, in the order of their declaration."""
        mixins = [c for c in reversed(cls.__mro__) if issubclass(c, Options) and c.__dict__.get('IS_GROUP')]
        return [name for c in mixins for name in c.__annotations__]

    def settle(self, settings):
        """Takes what was not given from the scene's settings."""
        for name in self.names():
            if not self.properties.is_property_set(name):
                setattr(self, name, getattr(settings, name))


class SearchOptions(Options):
    """How the facets find their places."""

    IS_GROUP = True

    strategy: EnumProperty(
        name="Strategy",
        description="How the facets of the polycube find their places",
        items=(
            ('best', "Best", "Search for the fewest blocks; offers the Simplicity slider"),
            ('paper', "Paper", "Align corners round by round, as published in 2016; quick"),
            ('naive', "Round", "Only round every facet to the lattice; may break the polycube"),
        ),
        default='best',
        options=FORGET,
    )
    objective: EnumProperty(
        name="Fewest",
        description="The number that the search makes small",
        items=(
            ('AUTO', "Automatic", "Patches of surfaces, and blocks with padding where the shape is filled with hexahedra"),
            ('surface_patches', "Patches", "Quadrilateral patches of the surface"),
            ('blocks', "Blocks", "Blocks of the solid"),
            ('blocks_padded', "Blocks with Padding", "Blocks of the solid once a layer of hexahedra is laid around it"),
        ),
        default='AUTO',
        options=FORGET,
    )
    simplicity: FloatProperty(**SIMPLICITY, options=FORGET)
    max_displacement: FloatProperty(
        name="Farthest Move",
        description="The farthest that a corner of the polycube may move, in scene units. 0 for as far as it takes",
        min=0.0,
        default=0.0,
        subtype='DISTANCE',
        options=FORGET,
    )
    max_distortion: FloatProperty(
        name="Most Distortion",
        description="How much the map from shape to polycube may bend angles on average, 1 or more: 1 keeps them, "
        "larger numbers are worse. 0 for no limit",
        min=0.0,
        default=0.0,
        options=FORGET,
    )
    locks: EnumProperty(
        name="Keep in Place",
        description="Facets of the polycube that may not move",
        items=(
            ('NONE', "Nothing", "Every facet may move"),
            ('SELECTION', "Selected Faces", "Facets with a selected face of the polycube stay where they are"),
            ('GROUP', "Vertex Group", "Facets with a face whose vertices are all in this group stay where they are"),
        ),
        default='NONE',
        options=FORGET,
    )
    lock_group: StringProperty(
        name="Group",
        description="Vertex group of the polycube's object whose facets may not move",
        options=FORGET,
    )
    symmetry: BoolVectorProperty(
        name="Symmetry",
        description="Planes through the origin of the polycube's object, across these axes, that the polycube is "
        "symmetric about and stays so, up to a step of the lattice",
        subtype='XYZ',
        options=FORGET,
    )
    steps: IntProperty(
        name="Effort",
        description="How long the strategy Best searches: moves tried per facet in each of eight runs",
        min=1,
        max=100_000,
        default=400,
        options=FORGET,
    )


class ToleranceOptions(Options):
    """How far a mesh may be from an exact polycube."""

    IS_GROUP = True

    angle_tolerance: FloatProperty(
        name="Angle",
        description="Largest angle between a face of the polycube and the nearest axis",
        min=0.0,
        max=math.radians(45.0),
        default=math.radians(30.0),
        subtype='ANGLE',
        options=FORGET,
    )
    level_tolerance: FloatProperty(
        name="Flatness",
        description="Largest distance of a vertex from the plane of its facet, in percent of the polycube's diagonal",
        min=0.0,
        max=100.0,
        default=5.0,
        subtype='PERCENTAGE',
        options=FORGET,
    )

    def tolerances(self):
        """These options as the core takes them."""
        return {
            # Blender keeps 45 degrees as a little more.
            "angle_tolerance": min(math.degrees(self.angle_tolerance), 45.0),
            "level_tolerance": self.level_tolerance / 100.0,
        }


class MakeOptions(Options):
    """How a polycube is made where none is chosen."""

    IS_GROUP = True

    detail: FloatProperty(
        name="Detail",
        description="How closely a polycube that is made follows the shape, from 0, as few corners as can be, to 1",
        min=0.0,
        max=1.0,
        default=0.5,
        subtype='FACTOR',
        options=FORGET,
    )
    axes: EnumProperty(
        name="Axes",
        description="Which directions of the shape become the axes of a polycube that is made",
        items=(
            ('KEEP', "Local", "Those of the object"),
            ('BEST', "Best", "Those that the surface looks along best, for a shape that lies askew"),
        ),
        default='KEEP',
        options=FORGET,
    )

    def making(self):
        """What the module takes."""
        return {"detail": self.detail, "axes": self.axes.lower()}


class SimplifyOptions(SearchOptions, ToleranceOptions):
    """How a polycube is simplified, and where the result goes."""

    IS_GROUP = True

    lattice: EnumProperty(
        name="Lattice",
        description="Length of a step of the lattice that facets come to lie on",
        items=(
            ('AUTO', "Automatic", "1 if all facets lie on whole numbers, else the mean length of the mesh's edges"),
            ('STEP', "Step", "A length of your own"),
        ),
        default='AUTO',
        options=FORGET,
    )
    lattice_step: FloatProperty(
        name="Step",
        description="Length of a step of the lattice, in scene units",
        min=1e-6,
        default=1.0,
        subtype='DISTANCE',
        options=FORGET,
    )
    output: EnumProperty(
        name="Result",
        description="Where the simplified polycube goes; what was there is kept",
        items=(
            ('AUTO', "Like the Input", "A shape key where the polycube is one, an object where it is one"),
            ('OBJECT', "New Object", "A copy of the polycube's object"),
            ('KEY', "New Shape Key", "A shape key of the polycube's object"),
        ),
        default='AUTO',
        options=FORGET,
    )


class MeshOptions(Options):
    """How a shape is meshed."""

    IS_GROUP = True

    blocks_from: EnumProperty(
        name="Blocks",
        description="The block structure that the mesh gets",
        items=(
            ('SHOWN', "As Simplified", "That of the simplified polycube, as the Simplicity slider shows it; "
             "where there is none, simplify first"),
            ('SEARCH', "Search", "Simplify the polycube anew, with an eye on the quality of the mesh"),
        ),
        default='SHOWN',
        options=FORGET,
    )
    size: EnumProperty(
        name="Size",
        description="How fine the mesh is",
        items=(
            ('AUTO', "Automatic", "One face per step of the lattice"),
            ('LENGTH', "Edge Length", "A mean length of the edges"),
            ('COUNT', "Hexahedra", "A number of hexahedra, those of the padding included"),
        ),
        default='AUTO',
        options=FORGET,
    )
    edge_length: FloatProperty(
        name="Edge Length",
        description="Mean length of the edges, in scene units",
        min=1e-6,
        default=1.0,
        subtype='DISTANCE',
        options=FORGET,
    )
    hexes: IntProperty(
        name="Hexahedra",
        description="About how many hexahedra fill the shape, those of the padding included",
        min=1,
        max=10_000_000,
        default=5000,
        options=FORGET,
    )


class VolumeOptions(MeshOptions):
    """How the inside of a shape is meshed."""

    IS_GROUP = True

    padding: IntProperty(
        name="Padding",
        description="Layers of hexahedra between the block structure and the surface",
        min=0,
        max=16,
        default=1,
        options=FORGET,
    )


class Inputs:
    """Where shape and polycube are."""

    source: EnumProperty(
        name="From",
        description="Where shape and polycube are",
        items=(
            ('OBJECTS', "Objects", "One object, of which a polycube is made, or two with the same vertices and faces: "
             "the shape and its polycube"),
            ('KEY', "Shape Key", "One object: its basis is the shape, a shape key is the polycube"),
        ),
        default='OBJECTS',
    )
    shape: PointerProperty(
        name="Shape",
        description="The object to mesh; the active one if none is chosen. Its vertices and faces must be those of the "
        "polycube, if there is one",
        type=bpy.types.Object,
        poll=is_mesh,
    )
    polycube: PointerProperty(
        name="Polycube",
        description="The shape deformed so that every face looks along an axis of this object. One is made if none is "
        "chosen",
        type=bpy.types.Object,
        poll=is_mesh,
    )
    key: StringProperty(
        name="Polycube Key",
        description="The shape key that deforms the shape into its polycube",
        default="Polycube",
    )


class Result(bpy.types.PropertyGroup):
    """Numbers about the last result, for the panel."""

    token: IntProperty(default=0)
    object: PointerProperty(type=bpy.types.Object)
    key: StringProperty()
    patches: IntVectorProperty(size=2)
    blocks: IntVectorProperty(size=2)
    padded: IntVectorProperty(size=2)
    displacement: FloatProperty(unit='LENGTH')
    notes: StringProperty()
    meshed: StringProperty()
    hexes: PointerProperty(type=bpy.types.Object)
    hexes_token: IntProperty(default=0)


class PolycubeSettings(Inputs, MakeOptions, SimplifyOptions, VolumeOptions, bpy.types.PropertyGroup):
    """The panel's settings: `scene.polycube`."""

    simplicity: FloatProperty(**SIMPLICITY, update=live.slide)
    colour: EnumProperty(
        name="Colour",
        description="What the colours of the results show",
        items=colours.ITEMS,
        default='block_id',
        update=colours.repaint,
    )
    cut: FloatProperty(
        name="Cut Away",
        description="How much of the hexahedra is taken away to show the inside, as a part of their length along the axis",
        min=0.0,
        max=1.0,
        default=0.5,
        subtype='FACTOR',
        update=live.cut,
    )
    cut_axis: EnumProperty(
        name="Cut Along",
        description="The axis of the object along which hexahedra are taken away",
        items=(
            ('X', "X", "From the right"),
            ('Y', "Y", "From the front"),
            ('Z', "Z", "From above"),
        ),
        default='Y',
        update=live.cut,
    )
    result: PointerProperty(type=Result)


CLASSES = (Result, PolycubeSettings)
