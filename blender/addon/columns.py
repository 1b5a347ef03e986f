"""Attributes of curves as a groom's columns, and columns as attributes.

Blender's own names stand for what a groom knows by others: `radius` is half of `width`, in the same
unit, and `surface_uv_coordinate` is `uv`. Attributes of more than one point or strand are left out,
as are those that hold no numbers.
"""

import numpy as np

from . import hair

RADIUS = "radius"
SURFACE_UV = "surface_uv_coordinate"

#: Kinds of attributes: where their numbers are, and how many there are.
KINDS = {
    "FLOAT": ("value", 1, np.float32),
    "INT": ("value", 1, np.int32),
    "BOOLEAN": ("value", 1, bool),
    "FLOAT2": ("vector", 2, np.float32),
    "FLOAT_VECTOR": ("vector", 3, np.float32),
    "FLOAT_COLOR": ("color", 4, np.float32),
}

#: The kind for so many floating-point numbers.
BY_COMPONENTS = {1: "FLOAT", 2: "FLOAT2", 3: "FLOAT_VECTOR", 4: "FLOAT_COLOR"}

#: What is not handed on: positions, and what the add-on keeps for itself.
OWN = {"position", hair.ORIGINAL, hair.REST}


def of_curves(curves, scale=1.0):
    """Columns of points and of strands; widths are scaled."""
    columns = {"POINT": {}, "CURVE": {}}
    for attribute in curves.attributes:
        name, kind = attribute.name, KINDS.get(attribute.data_type)
        if kind is None or name in OWN or name.startswith(".") or attribute.domain not in columns:
            continue
        values = read(attribute, kind)
        if name == RADIUS:
            name, values = "width", 2 * scale * values
        elif name == SURFACE_UV:
            name = "uv"
        columns[attribute.domain][name] = values
    return columns["POINT"], columns["CURVE"]


def read(attribute, kind):
    """The numbers of an attribute, rows of several where it has them."""
    field, components, dtype = kind
    values = np.empty(len(attribute.data) * components, dtype)
    if len(values):
        attribute.data.foreach_get(field, values)
    return values if components == 1 else values.reshape(-1, components)


def to_curves(curves, groom, scale=1.0):
    """Writes the columns of a groom without empty strands; widths are scaled."""
    for domain, columns in (("CURVE", groom.strand_attributes), ("POINT", groom.point_attributes)):
        for name, values in columns.items():
            if name == "width" and values.ndim == 1:
                radii = 0.5 * scale * values
                of_points = np.repeat(radii, groom.counts) if domain == "CURVE" else radii
                write(curves, RADIUS, "POINT", of_points)
            elif name == "uv" and domain == "CURVE" and values.ndim == 2 and values.shape[1] == 2:
                write(curves, SURFACE_UV, domain, values)
            else:
                write(curves, name, domain, values)


def write(curves, name, domain, values):
    """Writes an attribute; rows of more numbers than Blender has a kind for are left out."""
    components = 1 if values.ndim == 1 else values.shape[1]
    whole = values.ndim == 1 and np.issubdtype(values.dtype, np.integer)
    kind = "INT" if whole else BY_COMPONENTS.get(components)
    if kind is None or name in OWN:
        return
    field, _components, dtype = KINDS[kind]
    attribute = hair.fresh_attribute(curves, name, kind, domain)
    attribute.data.foreach_set(field, np.ascontiguousarray(values, dtype).ravel())
