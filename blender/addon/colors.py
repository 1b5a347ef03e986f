"""Colour by what curvatures say: an attribute with the numbers, one with colours, a material."""

import bpy
import numpy as np
import tress
from bpy.props import BoolProperty, EnumProperty, IntProperty

from . import hair
from .hair_operator import ELEMENTS, HairOperator

COLOR = "tress_color"
MATERIAL = "Tress Colors"

#: The material that the hair had before it was coloured, kept on the curves.
OWN_MATERIAL = "tress_material"

#: Quantities: what they are called and mean, and whether both sides of zero mean something.
QUANTITIES = {
    "radius": ("Coil Radius", "Distance from the line that the strand winds about", False),
    "frequency": ("Frequency (omega)", "Turns in a length of that line", False),
    "beta": ("Beta", "1 for a right-handed coil, -1 for a left-handed one, 0 for a wave", True),
    "pitch": ("Pitch", "Advance along that line in one turn, negative to the left", True),
    "curvature": ("Curvature", "Of the coil", False),
    "twist": ("Twist", "Of the coil, positive to the right", True),
    "turns": ("Turns", "From root to tip", False),
    "length": ("Length", "Of the strand", False),
    "handedness": ("Handedness", "1 right, -1 left, 0 neither", True),
}

#: Five colours of viridis, dark to light, and blue over white to red; linear between them.
SEQUENTIAL = ((68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37))
DIVERGING = ((33, 60, 140), (130, 170, 220), (245, 245, 245), (230, 150, 120), (160, 20, 40))


class TRESS_OT_color(HairOperator, bpy.types.Operator):
    """Write a quantity as an attribute, and show it as the hair's colour"""

    bl_idname = "tress.color"
    bl_label = "Color by Quantity"

    quantity: EnumProperty(
        name="Quantity",
        items=[(name, label, words) for name, (label, words, _) in QUANTITIES.items()],
    )
    material: BoolProperty(
        name="Material",
        description="Give the hair a material that shows the colours",
        default=True,
    )
    elements: IntProperty(**ELEMENTS)

    def run(self, _context, obj):
        polylines = hair.groom(obj)
        values = at_points(polylines, self.quantity, self.elements)
        name = f"tress_{self.quantity}"
        hair.set_numbers(obj.data, name, np.nan_to_num(values))
        signed = QUANTITIES[self.quantity][2]
        low, high = ends(values, signed)
        rgba = ramp(values, low, high, DIVERGING if signed else SEQUENTIAL)
        attribute = hair.fresh_attribute(obj.data, COLOR, "FLOAT_COLOR", "POINT")
        attribute.data.foreach_set("color", rgba.astype(np.float32).ravel())
        if self.material:
            show(obj)
        obj.data.update_tag()
        return f"{name}: {low:.3g} to {high:.3g}"


def at_points(polylines, quantity, elements=0):
    """A quantity with one number a point; NaN where there is none."""
    helices, _report = hair.fitted(polylines, elements)
    values = tress.quantity(helices, quantity)
    if len(values) == len(polylines):
        return np.repeat(values, polylines.counts)
    sampled = tress.sample(helices.with_attributes(joint={"it": values}), counts=polylines.counts)
    missing = np.full(len(polylines.positions), np.nan)
    return sampled.point_attributes.get("it", missing)


def ends(values, signed):
    """The ends of a scale: all values but one stray in fifty at either end."""
    finite = values[np.isfinite(values)]
    if not len(finite):
        return 0.0, 1.0
    low, high = np.quantile(finite, [0.02, 0.98])
    if signed:
        high = max(abs(low), abs(high))
        low = -high
    return float(low), float(max(high, low + 1e-12))


def ramp(values, low, high, colors):
    """Linear-light colours of values, grey for NaN."""
    srgb = np.array(colors) / 255
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    place = np.clip((values - low) / (high - low), 0, 1) * (len(colors) - 1)
    stops = np.arange(len(colors))
    rgba = np.ones((len(values), 4))
    for channel in range(3):
        rgba[:, channel] = np.interp(place, stops, linear[:, channel])
    rgba[~np.isfinite(values), :3] = 0.2
    return rgba


def show(obj):
    """Gives the object a material that takes its colour from the attribute."""
    material = bpy.data.materials.get(MATERIAL)
    if material is None:
        material = bpy.data.materials.new(MATERIAL)
        if material.node_tree is None:
            material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        attribute = nodes.new("ShaderNodeAttribute")
        attribute.attribute_name = COLOR
        attribute.location = (-300, 300)
        shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
        links.new(attribute.outputs["Color"], shader.inputs["Base Color"])
        shader.inputs["Roughness"].default_value = 0.6
    slots = obj.data.materials
    if not len(slots):
        slots.append(material)
    elif slots[0] != material:
        obj.data[OWN_MATERIAL] = slots[0]
        slots[0] = material


def give_back_material(obj):
    """Puts the material back that the hair had before it was coloured."""
    slots = obj.data.materials
    if not len(slots) or slots[0] is None or slots[0].name != MATERIAL:
        return
    own = obj.data.get(OWN_MATERIAL)
    if own is None:
        slots.clear()
        return
    slots[0] = own
    del obj.data[OWN_MATERIAL]


def register():
    bpy.utils.register_class(TRESS_OT_color)


def unregister():
    bpy.utils.unregister_class(TRESS_OT_color)
