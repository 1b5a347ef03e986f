"""Curves objects as grooms, and grooms as curves objects.

Everything happens in the object's own space. The positions that the hair had before the first edit
are kept in the attribute `tress_original`, so that every edit can be taken back, also long after
undo has forgotten it.
"""

import hashlib
from collections import OrderedDict

import bpy
import numpy as np
import tress

ORIGINAL = "tress_original"

#: The positions at rest of hair that has an armature.
REST = "tress_rest"

#: Fits that are remembered: adjusting an operator's settings runs it again on the same hair.
MOST_FITS = 4

_fits = OrderedDict()


def is_hair(obj):
    """Whether an object is hair that can be edited now."""
    return obj is not None and obj.type == "CURVES" and obj.mode == "OBJECT" and not obj.library


def positions(curves):
    """The points of a curves data-block, (n, 3) float32."""
    values = np.empty(len(curves.points) * 3, np.float32)
    if len(values):
        curves.position_data.foreach_get("vector", values)
    return values.reshape(-1, 3)


def offsets(curves):
    """Where strands begin among the points, and the number of points."""
    values = np.zeros(len(curves.curves) + 1, np.int32)
    if len(curves.curves):
        curves.curve_offset_data.foreach_get("value", values)
    return values


def groom(obj, points=None):
    """The groom of a curves object, or of other positions for its points."""
    curves = obj.data
    scale = bpy.context.scene.unit_settings.scale_length
    points = positions(curves) if points is None else points
    return tress.Groom(points, offsets(curves), unit=scale, up="z")


def fitted(polylines, elements=0):
    """The super-helices of a groom and the report of the fit, remembered for the last few grooms.

    `elements` is the number of elements a strand; 0 is one a segment.
    """
    digest = hashlib.blake2b(polylines.positions.tobytes())
    digest.update(polylines.offsets.tobytes())
    key = digest.digest(), elements
    if key not in _fits:
        options = {"elements": elements} if elements else {}
        _fits[key] = tress.fit(polylines, **options)
        while len(_fits) > MOST_FITS:
            _fits.popitem(last=False)
    _fits.move_to_end(key)
    return _fits[key]


def forget_fits():
    """Lets the memory of remembered fits go."""
    _fits.clear()


def move(obj, points):
    """Puts the points of a curves object elsewhere, (n, 3)."""
    curves = obj.data
    curves.position_data.foreach_set("vector", np.asarray(points, np.float32).ravel())
    curves.update_tag()


def keep_original(obj):
    """Keeps the positions as they are now, unless those before an earlier edit are kept."""
    if ORIGINAL not in obj.data.attributes:
        set_vectors(obj.data, ORIGINAL, positions(obj.data))


def original(obj):
    """The positions before the first edit, or None."""
    return vectors(obj.data, ORIGINAL)


def vectors(curves, name):
    """An attribute of points of three numbers, or None where there is none of that kind."""
    attribute = curves.attributes.get(name)
    if attribute is None or (attribute.domain, attribute.data_type) != ("POINT", "FLOAT_VECTOR"):
        return None
    values = np.empty(len(attribute.data) * 3, np.float32)
    attribute.data.foreach_get("vector", values)
    return values.reshape(-1, 3)


def set_vectors(curves, name, values):
    """Writes an attribute of points of three numbers."""
    attribute = fresh_attribute(curves, name, "FLOAT_VECTOR", "POINT")
    attribute.data.foreach_set("vector", np.asarray(values, np.float32).ravel())


def set_numbers(curves, name, values):
    """Writes an attribute of one number a point, or one a strand where there are as many."""
    domain = "CURVE" if len(values) == len(curves.curves) else "POINT"
    kind = "INT" if np.issubdtype(np.asarray(values).dtype, np.integer) else "FLOAT"
    attribute = fresh_attribute(curves, name, kind, domain)
    dtype = np.int32 if kind == "INT" else np.float32
    attribute.data.foreach_set("value", np.asarray(values, dtype))
    return domain


def fresh_attribute(curves, name, kind, domain):
    """The attribute of this name, of this kind: another of the name is replaced."""
    attribute = curves.attributes.get(name)
    if attribute is not None and (attribute.data_type, attribute.domain) != (kind, domain):
        curves.attributes.remove(attribute)
        attribute = None
    if attribute is None:
        attribute = curves.attributes.new(name, kind, domain)
    return attribute


def new_object(context, name, polylines, like=None):
    """A curves object of a groom, linked to the scene; strands without points are left out.

    `like` is a curves object whose place, surface and materials it takes over.
    """
    counts = polylines.counts
    curves = bpy.data.hair_curves.new(name)
    curves.add_curves([int(count) for count in counts if count])
    curves.position_data.foreach_set("vector", polylines.positions.astype(np.float32).ravel())
    obj = bpy.data.objects.new(name, curves)
    if like is not None:
        for material in like.data.materials:
            curves.materials.append(material)
        curves.surface = like.data.surface
        curves.surface_uv_map = like.data.surface_uv_map
        obj.matrix_world = like.matrix_world
    context.collection.objects.link(obj)
    return obj


def with_edit(obj, elements, edit):
    """Fits the hair, lets `edit` change its super-helices, and moves the points accordingly.

    `edit` gets a HelixGroom and gives one of the same strands back and a report, which is returned.
    """
    before = groom(obj)
    helices, _report = fitted(before, elements)
    changed, report = edit(helices)
    after = tress.sample(changed, counts=before.counts)
    keep_original(obj)
    move(obj, after.positions)
    return report


def wisps(helices, clusters, seed):
    """The cluster of each strand, or None where all strands are one."""
    clusters = min(clusters, len(helices))
    return tress.groups(helices, clusters=clusters, seed=seed) if clusters else None
